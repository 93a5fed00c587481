! A system without inertia.
program test_overdamped
  use check
  use hooke
  use scenes, only: make_run
  implicit none
  type(hooke_system) :: system
  type(hooke_options) :: run, springs
  type(hooke_integrator) :: integrator
  type(hooke_state) :: state
  real(hooke_real) :: q(3, 2), none(0)
  integer :: status

  q = 0
  q(1, 2) = 1.5_hooke_real
  call system%create()
  call system%set_dynamics("slow", status)
  call expect(status == hooke_bad_value, "a word that is none")
  call system%set_dynamics("overdamped")
  call expect(system%dynamics() == "overdamped", "no inertia")
  call system%add_particles(q, none)
  call system%set_drag(2.0_hooke_real)
  call springs%create("springs")
  call springs%set("stiffness", 30.0_hooke_real)
  call springs%set("rest_length", 1.0_hooke_real)
  call system%add_springs(reshape([1, 2], [2, 1]), springs, "pair")
  call system%commit()
  call make_run(run, "rk4", 1e-3_hooke_real, 0.1_hooke_real)
  call integrator%create(system, run)
  call state%create(system)
  call integrator%run(state)
  call expect_near(state%q(1, 2) - state%q(1, 1), 1 + 0.5_hooke_real*exp(-3.0_hooke_real), 1e-9_hooke_real, "relaxed")
  call expect_near(state%v(1, 2), -7.5_hooke_real*exp(-3.0_hooke_real), 1e-7_hooke_real, "force over drag")
  call finish()
end program
