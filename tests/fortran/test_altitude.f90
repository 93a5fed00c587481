! Altitude springs: one tetrahedron, its numbers and its force.
program test_altitude
  use check
  use hooke
  implicit none
  call test_one_tetrahedron()
  call finish()

contains

  subroutine test_one_tetrahedron()
    type(hooke_system) :: system
    type(hooke_options) :: spring
    type(hooke_state) :: state
    integer, allocatable :: ends(:, :)
    real(hooke_real), allocatable :: stiffness(:), damping(:), rest_length(:), length(:)
    real(hooke_real) :: q(3, 4), step(3, 4), f(3, 4), slope
    integer :: status

    q = reshape([0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 1]*1.0_hooke_real, [3, 4])
    call system%create()
    call system%add_particles(q, 1.0_hooke_real)
    call spring%create("altitude")
    call spring%set("stiffness", 10)
    call spring%set("damping", 0.5_hooke_real)
    call system%add_altitude(reshape([1, 2, 3], [3, 1]), spring, status=status)
    call expect(status == hooke_bad_value .and. index(hooke_message(), "(4, n)") > 0, "a tetrahedron has four corners")
    call system%add_altitude(reshape([1, 2, 3, 5], [4, 1]), spring, status=status)
    call expect(status == hooke_bad_value, "there is no particle 5")
    call system%add_altitude(reshape([1, 2, 3, 4], [4, 1]), spring, "tetrahedron")
    call system%commit()
    call expect(system%count("altitude") == 1 .and. system%group_count("altitude") == 1, "one of them")
    call expect(system%group_name("altitude", 1) == "tetrahedron" .and. system%group_size("altitude", 1) == 1, "by name")
    call system%members("altitude", ends)
    call expect(all(shape(ends) == [4, 1]) .and. all(ends(:, 1) == [1, 2, 3, 4]), "numbers count from 1")
    call system%members("altitude", stiffness=stiffness, damping=damping, rest_length=rest_length)
    call expect(same(stiffness(1), 10.0_hooke_real) .and. same(damping(1), 0.5_hooke_real), "its material")
    call expect(size(rest_length) == 7, "seven altitudes")
    call expect_near(rest_length(4), 1.0_hooke_real, 1e-14_hooke_real, "from particle 4 to the face of the others")
    call state%create(system)
    call system%altitude_lengths(state%q, length)
    call expect_near(abs(length(1)), minval(abs(rest_length)), 1e-14_hooke_real, "the shortest acts")
    call expect_near(system%energy("altitude", state%q), 0.0_hooke_real, 1e-20_hooke_real, "at rest")
    q(3, 4) = 0.7_hooke_real
    call expect(system%energy("altitude", q) > 0, "and not when it is pressed")
    call system%force(0.0_hooke_real, q, 0*q, f)
    step = q
    step(3, 4) = q(3, 4) + 1e-6_hooke_real
    slope = system%energy("altitude", step)
    step(3, 4) = q(3, 4) - 1e-6_hooke_real
    slope = (slope - system%energy("altitude", step))/2e-6_hooke_real
    call expect_near(f(3, 4), -slope, 1e-7_hooke_real, "the force is the slope of the energy")
  end subroutine

end program
