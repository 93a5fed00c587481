! A rope made of options: the same bits as from C by every method, energies, counts and time loops.
program test_rope
  use, intrinsic :: iso_c_binding, only: c_null_char
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use check
  use hooke
  use scenes, only: make_run
  implicit none

  call same_bits()
  call own_loop()
  call questions()
  call finish()

contains

  subroutine make(system)
    type(hooke_system), intent(inout) :: system
    type(hooke_options) :: rope
    integer :: first, count
    call system%create()
    call rope%create("rope")
    call rope%set("from", [0, 0, 0])
    call rope%set("to", [1.0_hooke_real, 0.0_hooke_real, 0.25_hooke_real])
    call rope%set("segments", 8)
    call rope%set("mass", 0.25_hooke_real)
    call rope%set("pinned", "start")
    call rope%set("stretch.stiffness", 200)
    call rope%set("stretch.damping", 0.05_hooke_real)
    call rope%set("bending", 1e-4_hooke_real)
    call system%set_gravity([0.0_hooke_real, -9.81_hooke_real, 0.0_hooke_real])
    call system%set_drag(1e-3_hooke_real)
    call system%add_part("rope", rope, "rope", first, count)
    call expect(first == 1 .and. count == 9, "the particles of the rope are 1 to 9")
    call expect(.not. system%is_committed(), "the system is open")
    call system%commit()
    call expect(system%is_committed(), "the system is committed")
  end subroutine

  subroutine same_bits()
    type(hooke_system) :: system
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    real(hooke_real) :: q(3, 9), v(3, 9)
    character(:), allocatable :: method
    integer :: k, status, fixed
    call make(system)
    fixed = 0
    do k = 1, hooke_method_count()
      method = hooke_method_name(k)
      if (.not. hooke_method_is_built(method)) cycle
      if (.not. hooke_method_is_adaptive(method)) fixed = fixed + 1
      call make_run(run, method, 5e-4_hooke_real, 0.2_hooke_real)
      call integrator%create(system, run)
      call state%create(system)
      call integrator%run(state, status)
      call expect(status == hooke_ok, method // " runs")
      call expect(twin_rope(method // c_null_char, q, v) == 0, method // " runs in C")
      call expect(same_count([state%q, state%v], [q, v]) == 54, method // " gives the same bits")
      call expect(integrator%count("steps") > 0, method // " counts its steps")
      call expect(hooke_method_meant(method) == method, method // " means itself")
      call expect(len(hooke_method_summary(method)) > 10, method // " has a summary")
      call expect(hooke_method_is_suited(method, "second-order"), method // " takes particles")
    end do
    call expect(.not. hooke_method_is_suited("shardlow", "bodies"), "and not all take bodies")
    call expect(fixed == 9, "the nine methods of fixed step ran")
    call expect(hooke_method_name(hooke_method_count() + 1) == "", "no name past the last method")
  end subroutine

  subroutine own_loop()
    type(hooke_system) :: system
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state, twin
    integer :: k
    call make(system)
    call make_run(run, "verlet", 5e-4_hooke_real, 0.2_hooke_real)
    call integrator%create(system, run)
    call state%create(system)
    call twin%create(system)
    do k = 1, 40
      call integrator%step(state, 10)
    end do
    call integrator%run(twin)
    call expect(same_count([state%q, state%v], [twin%q, twin%v]) == 54, "400 steps in a loop are the run")
    call expect_near(state%time(), 0.2_hooke_real, 1e-15_hooke_real, "time after 400 steps")
    call expect(integrator%count("steps") == 800, "800 steps were counted")
    call expect(integrator%count("nothing of the kind") == -1, "no count of another word")
    call expect(integrator%count("frames") == 101, "frames by default: " // integrator%options%text("method"))
    call expect_near(integrator%options%number("every"), 0.002_hooke_real, 1e-15_hooke_real, "every, filled in")
    call state%set_time(3.0_hooke_real)
    call state%copy_to(twin)
    call expect_near(twin%time(), 3.0_hooke_real, 0.0_hooke_real, "time that was copied")
  end subroutine

  subroutine questions()
    type(hooke_system) :: system
    type(hooke_state) :: state
    integer, allocatable :: ends(:, :)
    real(hooke_real), allocatable :: kappa(:), gamma(:), length(:), coefficient(:)
    real(hooke_real), pointer :: w(:)
    real(hooke_real) :: l
    call make(system)
    call state%create(system)
    l = sqrt(1.0625_hooke_real)/8
    call expect(system%particle_count() == 9 .and. system%count("free") == 8, "nine particles, eight of them free")
    call expect(system%spring_count() == 8 .and. system%count("dropped_springs") == 0, "eight springs")
    call expect(system%group_count("springs") == 1 .and. system%group_size("springs", 1) == 8, "one group of eight")
    call expect(system%group_name("springs", 1) == "rope.stretch" .and. system%group_name("springs", 2) == "", "its name")
    call expect(system%count("bending") == 7 .and. system%group_size("bending", 1) == 7, "seven triples")
    call expect(system%group_count("bending") == 1 .and. system%group_name("bending", 1) == "rope.bending", "their group")
    call system%members("springs", ends)
    call expect(all(shape(ends) == [2, 8]) .and. all(ends(:, 8) == [8, 9]), "ends count from 1")
    call system%members("bending", ends)
    call expect(all(shape(ends) == [3, 7]) .and. all(ends(:, 1) == [1, 2, 3]), "triples count from 1")
    call system%members("bending", stiffness=coefficient)
    call expect_near(coefficient(7), 1e-4_hooke_real/l**3, 1e-9_hooke_real, "B/l^3")
    call system%members("springs", stiffness=kappa, damping=gamma, rest_length=length)
    call expect_near(kappa(1), 200/l, 1e-9_hooke_real, "kappa")
    call expect_near(gamma(8), 0.05_hooke_real/l, 1e-12_hooke_real, "gamma")
    call expect_near(length(3), l, 1e-15_hooke_real, "rest length")
    w => system%inverse_mass()
    call expect(size(w) == 9 .and. same(w(1), 0.0_hooke_real) .and. w(9) > 0, "inverse masses")
    call expect_near(sum(system%mass()), 0.25_hooke_real, 1e-15_hooke_real, "the mass of the rope")
    call expect_near(system%energy("total", state%q, state%v), system%energy("potential", state%q) &
      + system%energy("kinetic", v=state%v), 1e-15_hooke_real, "energy is potential and kinetic")
    call expect_near(system%energy("potential", state%q), system%energy("springs", state%q) + system%energy("bending", state%q) &
      + system%energy("gravity", state%q), 1e-15_hooke_real, "potential energy is that of its forces")
    call expect(ieee_is_nan(system%energy("total", state%q)), "without velocities the total is not known")
    call expect(system%count("forces") == 4 .and. system%force_name(4) == "gravity", "forces by name")
    call expect(system%count("memory") > system%count("spring_memory") .and. system%count("spring_memory") > 0, "memory")
    call expect(system%count("derived") > 0, "the bending was derived")
    call expect(system%derived_text(1, "part") == "rope", "from the rope")
    call expect(system%derived_value(1) > 0, "with a value")
    call expect(system%count("idle") == 0 .and. system%coincident_springs(state%q) == 0, "nothing idle or coincident")
  end subroutine
end program
