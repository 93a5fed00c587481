! Driven particles: by a procedure, a sine and a table.
program test_drives
  use check
  use hooke
  use parts
  use scenes, only: make_run
  implicit none
  real(hooke_real), parameter :: pi = acos(-1.0_hooke_real)

  call same_motion()
  call by_table()
  call stops()
  call finish()

contains

  ! A chain of four along x whose first particle is driven.
  subroutine make(system, first)
    type(hooke_system), intent(inout) :: system
    integer, intent(out), optional :: first
    type(hooke_options) :: spring
    real(hooke_real) :: position(3, 4)
    integer :: k
    position = 0
    position(1, :) = [(real(k, hooke_real), k=0, 3)]
    call system%create()
    call system%add_particles(position, 0.5_hooke_real, first=first)
    call spring%create("springs")
    call spring%set("stiffness", 20)
    call spring%set("damping", 0.2_hooke_real)
    call system%add_springs(reshape([1, 2, 2, 3, 3, 4], [2, 3]), spring)
  end subroutine

  subroutine go(system, state, status)
    type(hooke_system), intent(inout) :: system
    type(hooke_state), intent(inout) :: state
    integer, intent(out) :: status
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    call system%commit()
    call make_run(run, "rk4", 1e-2_hooke_real, 1.0_hooke_real)
    call integrator%create(system, run)
    call state%create(system)
    call integrator%run(state, status)
    call expect(integrator%stop_value() == merge(5, 0, status == hooke_stopped), "the value that stopped it")
  end subroutine

  subroutine same_motion()
    type(hooke_system) :: harmonic, own
    type(hooke_state) :: wanted, found
    type(sine), target :: drive
    integer :: first, status
    call make(harmonic, first)
    call expect(first == 1, "the first particle is 1")
    call harmonic%drive_harmonic(1, [0.1_hooke_real, 0.0_hooke_real, 0.0_hooke_real], 0.8_hooke_real)
    call go(harmonic, wanted, status)
    call expect(status == hooke_ok, "the sine ran")
    call make(own)
    drive = sine(start=reshape([0, 0, 0]*1.0_hooke_real, [3, 1]), amplitude=0.1_hooke_real, omega=1.6_hooke_real*pi)
    call own%drive_callback([1], drive)
    call go(own, found, status)
    call expect(status == hooke_ok, "the procedure ran")
    call expect(maxval(abs(found%q - wanted%q)) < 1e-13_hooke_real, "both move the chain alike")
    call expect_near(found%q(1, 1), 0.1_hooke_real*sin(1.6_hooke_real*pi), 1e-13_hooke_real, "the driven particle")
    call expect(abs(found%q(1, 2) - 1) > 1e-3_hooke_real, "its neighbour moves")
    call expect(own%count("free") == 3, "it is not free")
  end subroutine

  subroutine by_table()
    type(hooke_system) :: system
    type(hooke_state) :: state
    real(hooke_real) :: displacement(3, 3)
    integer :: status
    displacement = 0
    displacement(2, :) = [0.0_hooke_real, 0.25_hooke_real, 0.5_hooke_real]
    call make(system)
    call system%drive_table([1], [0.0_hooke_real, 0.5_hooke_real, 1.0_hooke_real], displacement(:2, :), status)
    call expect(status == hooke_bad_value, "rows of two are refused")
    call expect_text(hooke_message(), "(3, n)", "with the shape that is wanted")
    call system%drive_table([1], [0.0_hooke_real, 0.5_hooke_real, 1.0_hooke_real], displacement)
    call go(system, state, status)
    call expect(status == hooke_ok, "the table ran")
    call expect_near(state%q(2, 1), 0.5_hooke_real, 1e-15_hooke_real, "the end of the table")
    call expect_near(state%q(1, 1), 0.0_hooke_real, 1e-15_hooke_real, "and nowhere else")
  end subroutine

  subroutine stops()
    type(hooke_system) :: system
    type(hooke_state) :: state
    type(sine), target :: drive
    integer :: status
    call make(system)
    drive = sine(start=reshape([0, 0, 0]*1.0_hooke_real, [3, 1]), amplitude=0.1_hooke_real, omega=1.0_hooke_real, &
      stop_at=0.305_hooke_real)
    call system%drive_callback([1], drive)
    call system%drive_callback([1], drive, status)
    call expect(status == hooke_bad_value, "driven once at most")
    call expect_text(hooke_message(), "0", "messages count from 0")
    call go(system, state, status)
    call expect(status == hooke_stopped, "the motion stopped the run")
    call expect_near(state%time(), 0.3_hooke_real, 1e-12_hooke_real, "at the last whole step")
  end subroutine
end program
