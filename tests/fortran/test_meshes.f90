! Meshes from arrays and from OBJ files.
program test_meshes
  use check
  use hooke
  implicit none

  call same_surface()
  call refusals()
  call finish()

contains

  ! Two triangles over a square, as numbers and as a file.
  subroutine same_surface()
    type(hooke_options) :: arrays, file
    real(hooke_real) :: vertices(3, 4)
    integer :: unit
    vertices = reshape([0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0]*1.0_hooke_real, [3, 4])
    call arrays%create("mesh")
    call arrays%set_mesh(vertices, reshape([1, 2, 3, 1, 3, 4], [3, 2]))
    open (newunit=unit, file=output("square.obj"), action="write")
    write (unit, "(a)") "v 0 0 0", "v 2 0 0", "v 2 1 0", "v 0 1 0", "f 1 2 3 4"
    close (unit)
    call file%create("mesh")
    call file%read_mesh(output("square.obj"))
    call look_at(arrays)
    call look_at(file)
  end subroutine

  subroutine look_at(mesh)
    type(hooke_options), intent(inout) :: mesh
    type(hooke_system) :: system
    type(hooke_state) :: state
    integer, allocatable :: ends(:, :)
    integer :: first, count, k
    call mesh%set("mass", 3)
    call mesh%set("structural.stiffness", 10)
    call system%create()
    call system%add_part("mesh", mesh, "square", first, count)
    call system%commit()
    call expect(first == 1 .and. count == 4 .and. system%spring_count() == 5, "four particles and five edges")
    call system%members("springs", ends)
    call expect(any([(ends(1, k) == 1 .and. ends(2, k) == 3, k=1, 5)]), "the diagonal is between 1 and 3")
    call state%create(system)
    call expect(same_count(state%q(:, 3), [2, 1, 0]*1.0_hooke_real) == 3, "particle 3 is vertex 3")
    call expect_near(sum(system%mass()), 3.0_hooke_real, 1e-15_hooke_real, "mass")
  end subroutine

  subroutine refusals()
    type(hooke_options) :: mesh, run
    type(hooke_system) :: system
    real(hooke_real) :: vertices(3, 3)
    integer :: status
    vertices = reshape([0, 0, 0, 1, 0, 0, 0, 1, 0]*1.0_hooke_real, [3, 3])
    call mesh%create("mesh")
    call mesh%set_mesh(vertices(:2, :), reshape([1, 2, 3], [3, 1]), status)
    call expect(status == hooke_bad_value .and. index(hooke_message(), "(3, n)") > 0, "rows of two are no vertices")
    call mesh%set_mesh(vertices, reshape([1, 2, 4], [3, 1]), status)
    call expect(status == hooke_ok, "triangles are looked at when the part is added")
    call mesh%set("mass", 1)
    call system%create()
    call system%add_part("mesh", mesh, status=status)
    call expect(status == hooke_bad_value, "there is no vertex 4")
    call mesh%set_mesh(vertices, reshape([0, 1, 2], [3, 1]), status)
    call expect(status == hooke_bad_value, "nor a vertex 0")
    call mesh%create("mesh")
    call mesh%read_mesh("no-such-file.obj", status)
    call expect(status == hooke_bad_value, "a file that is none")
    call expect_text(hooke_message(), "no-such-file.obj", "by name")
    call run%create("run")
    call run%set_mesh(vertices, reshape([1, 2, 3], [3, 1]), status)
    call expect(status == hooke_bad_value, "a run has no mesh")
  end subroutine
end program
