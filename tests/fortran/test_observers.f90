! Observers of frames and steps, stops, warnings, and borrowed states.
program test_observers
  use check
  use hooke
  use parts
  use scenes
  implicit none

  call frames()
  call steps()
  call motion()
  call told_of_progress()
  call warnings()
  call finish()

contains

  subroutine frames()
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    type(watcher), target :: watch
    integer :: status
    call start_oscillator(integrator, state, "verlet", 1e-3_hooke_real, 0.1_hooke_real, 0.01_hooke_real)
    call integrator%on_frame(watch)
    call integrator%run(state, status)
    call expect(status == hooke_ok .and. watch%seen == integrator%count("frames") .and. watch%seen == 11, "eleven frames")
    call expect(watch%last == 100, "the last one after 100 steps")
    call expect(same_count(watch%q, state%q(:, 2)) == 3, "saw the final state")
    call expect(.not. watch%kept%exists(), "a state that was lent cannot be kept")
    call integrator%on_frame()
    call integrator%run(state)
    call expect(watch%seen == 11, "taken back")
    watch%stop_at = 30
    call integrator%on_frame(watch)
    call integrator%run(state, status)
    call expect(status == hooke_stopped .and. integrator%stop_value() == 42, "stopped, and by whom")
    call expect_near(state%time(), 0.23_hooke_real, 1e-12_hooke_real, "at the frame after 30 steps")
    call expect_text(hooke_message(), "returned 42", "and in words")
  end subroutine

  subroutine steps()
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    type(watcher), target :: first, second
    integer :: status
    call start_oscillator(integrator, state, "rk4", 1e-3_hooke_real, 0.1_hooke_real)
    call integrator%on_step(25, first)
    call integrator%on_step(50, second)
    call integrator%run(state)
    call expect(first%seen == 0 .and. second%seen == 2, "the second observer took the place of the first")
    call integrator%on_step(0, first, status)
    call expect(status == hooke_bad_value, "a stride of 0 is refused")
    call integrator%run(state)
    call expect(second%seen == 4, "and the observer before it stays")
    call integrator%on_step(1)
    call integrator%step(state, 100_hooke_long)
    call expect(second%seen == 4 .and. integrator%count("steps") == 300, "taken back")
  end subroutine

  ! Steps of the integrator's own motion, and some of its particles.
  subroutine motion()
    type(hooke_system) :: system
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator, steps
    type(hooke_state) :: state, other
    real(hooke_real) :: q(3, 2), v(3, 2), alone(3, 1)
    integer :: status
    call make_oscillator(system)
    call make_run(run, "verlet", 0.5_hooke_real**10, 1.0_hooke_real)
    call integrator%create(system, run)
    call steps%create(system, run)
    call state%create(system)
    call other%create(system)
    call integrator%advance(1, status)
    call expect(status == hooke_bad_call, "there is no motion yet")
    call integrator%step(state, 0)
    call integrator%advance(3)
    call integrator%advance(4_hooke_long)
    call integrator%sync(state)
    call steps%step(other, 7)
    call expect(same_count(state%q(:, 2), other%q(:, 2)) == 3, "the same steps")
    call integrator%get([2, 1], q, v)
    call expect(same_count(q(:, 1), state%q(:, 2)) == 3 .and. same_count(v(:, 1), state%v(:, 2)) == 3, "read")
    call integrator%get([1], velocity=alone)
    call expect(same_count(alone(:, 1), v(:, 2)) == 3, "velocities alone")
    alone(:, 1) = [0.1_hooke_real, 0.2_hooke_real, 0.3_hooke_real]
    call integrator%put([2], velocity=alone)
    call integrator%advance(5)
    call integrator%sync(state)
    other%v(:, 2) = alone(:, 1)
    call steps%step(other, 5)
    call expect(same_count(state%q(:, 2), other%q(:, 2)) == 3, "written")
    call integrator%put([3], alone, status=status)
    call expect(status == hooke_bad_value, "there is no such particle")
    call integrator%get([1, 2], alone, status=status)
    call expect(status == hooke_bad_value, "nor room for so many")
  end subroutine

  subroutine told_of_progress()
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    type(teller), target :: told
    integer :: status
    call start_oscillator(integrator, state, "rk4", 1e-3_hooke_real, 1e3_hooke_real)
    call integrator%on_progress(-1.0_hooke_real, told, status)
    call expect(status == hooke_bad_value, "seconds below 0 are refused")
    told%stop_after = 3
    call integrator%on_progress(0.0_hooke_real, told)
    call integrator%run(state, status)
    call expect(status == hooke_stopped .and. told%told == 3 .and. told%what == "rk4", "stopped by the third word")
    call integrator%on_progress(0.0_hooke_real)
    call integrator%step(state, 10)
    call expect(told%told == 3, "taken back")
  end subroutine

  subroutine warnings()
    type(hooke_system) :: system
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    type(warner), target :: warned
    integer :: status
    call make_oscillator(system)
    call make_run(run, "symplectic-euler", 0.4_hooke_real, 20.0_hooke_real)
    call integrator%create(system, run)
    call integrator%on_warning(warned, status)
    if (status == hooke_not_built) then
      call expect(hooke_build_fact("gsl") == "", "warnings in a build with GSL")
      return
    end if
    call expect(status == hooke_ok, "it will be warned")
    call state%create(system)
    call integrator%run(state, status)
    call expect(status == hooke_diverged .and. integrator%diverged_at() > 0, "it blew up: " // hooke_message())
    call expect(integrator%count("recent") >= 1, "and a good state is kept")
    call integrator%recent(1, state)
    call expect(maxval(abs(state%q)) < 1e6_hooke_real, "which is finite")
    call integrator%recent(100, state, status)
    call expect(status == hooke_bad_value, "there are not so many")
    call expect(warned%warnings == 1 .and. warned%kind == "above-limit", "it was warned before")
    call expect(warned%limit < 2/sqrt(40.0_hooke_real)*1.0001_hooke_real, "of the step that is safe")
    call expect(warned%spring == 1 .and. warned%particle == 2, "numbers count from 1")
    call integrator%on_warning()
    call state%create(system)
    call integrator%run(state, status)
    call expect(warned%warnings == 1, "taken back")
  end subroutine
end program
