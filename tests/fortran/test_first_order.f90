! Problems x' = phi(t, x).
program test_first_order
  use check
  use hooke
  use parts
  use scenes, only: make_run
  implicit none
  type(hooke_options) :: run
  type(hooke_integrator) :: integrator
  type(hooke_state) :: state
  type(turn), target :: rate
  integer :: status

  call make_run(run, "rk4", 1e-3_hooke_real, 1.0_hooke_real)
  call integrator%create_first_order(2, rate, run)
  call state%create_first_order(2)
  call expect(state%size() == 2 .and. size(state%x) == 2, "two numbers")
  call expect(.not. associated(state%q) .and. .not. associated(state%v), "which are no positions")
  state%x = [1.0_hooke_real, 0.0_hooke_real]
  call integrator%run(state)
  call expect_near(state%x(1), cos(1.0_hooke_real), 1e-12_hooke_real, "cosine")
  call expect_near(state%x(2), sin(1.0_hooke_real), 1e-12_hooke_real, "sine")

  rate%stop_at = 1.5_hooke_real
  rate%stop_value = -9
  call integrator%run(state, status)
  call expect(status == hooke_stopped .and. integrator%stop_value() == -9, "the rate stopped it")
  call expect_near(state%time(), 1.5_hooke_real, 2e-3_hooke_real, "in time")

  call run%set("method", "symplectic-euler")
  call integrator%create_first_order(2, rate, run, status)
  call expect(status == hooke_unsuited, "a method of positions and velocities is not for it")
  call expect(integrator%count("steps") > 1000, "and the integrator is what it was")
  call state%create_first_order(0, status)
  call expect(status == hooke_bad_value .and. state%exists(), "a state of no numbers is refused, the old one stays")
  call finish()
end program
