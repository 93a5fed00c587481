! One system, many threads: a run for each of eight methods and steps, each with its own state.
program threads
  use hooke
  implicit none
  type(hooke_system) :: system
  type(hooke_options) :: rope
  real(hooke_real) :: ends(3, 8)
  integer :: k

  call rope%create("rope")
  call rope%set("from", [0, 0, 0])
  call rope%set("to", [1, 0, 0])
  call rope%set("segments", 24)
  call rope%set("mass", 0.25_hooke_real)
  call rope%set("pinned", "start")
  call rope%set("stretch.stiffness", 200)
  call system%create()
  call system%add_part("rope", rope)
  call system%set_gravity([0.0_hooke_real, -9.81_hooke_real, 0.0_hooke_real])
  call system%commit()

  !$omp parallel do
  do k = 1, 8
    call run_one(merge("verlet", "rk4   ", k > 4), 1e-4_hooke_real/2**mod(k, 4), ends(:, k))
  end do
  !$omp end parallel do
  do k = 1, 8
    print "(i0, 3(1x, f0.3))", k, ends(:, k)
  end do

contains

  subroutine run_one(method, step, last)
    character(*), intent(in) :: method
    real(hooke_real), intent(in) :: step
    real(hooke_real), intent(out) :: last(3)
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    call run%create("run")
    call run%set("method", method)
    call run%set("step", step)
    call run%set("duration", 0.5_hooke_real)
    call integrator%create(system, run)
    call state%create(system)
    call integrator%run(state)
    last = state%q(:, 25)
  end subroutine
end program
