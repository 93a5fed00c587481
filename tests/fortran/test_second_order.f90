! Problems q'' = W f(t, q, v).
module springs_of_coordinates
  use hooke
  implicit none

  type, extends(hooke_coordinate_force) :: pull
    integer :: stop_value = 0
  contains
    procedure :: add => add_pull
  end type

  type, extends(hooke_coordinate_force_with_product) :: pull_with_product
    integer :: products = 0
  contains
    procedure :: add => add_known_pull
    procedure :: add_product
  end type

contains

  subroutine add_pull(self, n, t, q, v, force, stop_value)
    class(pull), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, q(n), v(n)
    real(hooke_real), intent(inout) :: force(n)
    integer, intent(inout) :: stop_value
    force = force - q + 0*v
    if (t > 0.5_hooke_real) stop_value = self%stop_value
  end subroutine

  subroutine add_known_pull(self, n, t, q, v, force, stop_value)
    class(pull_with_product), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, q(n), v(n)
    real(hooke_real), intent(inout) :: force(n)
    integer, intent(inout) :: stop_value
    force = force - q + 0*v
    if (t < 0) stop_value = self%products + 1
  end subroutine

  subroutine add_product(self, n, t, q, v, dq, dv, out, stop_value)
    class(pull_with_product), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, q(n), v(n), dq(n), dv(n)
    real(hooke_real), intent(inout) :: out(n)
    integer, intent(inout) :: stop_value
    out = out - dq + 0*(q + v + dv)
    self%products = self%products + 1
    if (t < 0) stop_value = 1
  end subroutine
end module

program test_second_order
  use check
  use hooke
  use scenes, only: make_run
  use springs_of_coordinates
  implicit none
  type(hooke_options) :: run
  type(hooke_integrator) :: integrator
  type(hooke_state) :: state
  type(pull), target :: force
  type(pull_with_product), target :: known
  integer :: status

  call make_run(run, "rk4", 1e-3_hooke_real, 1.0_hooke_real)
  call integrator%create_second_order(2, force, [1.0_hooke_real, 4.0_hooke_real], run)
  call state%create_second_order(2)
  call expect(state%size() == 2 .and. size(state%x) == 2 .and. size(state%dx) == 2, "two coordinates")
  state%x = 1
  call integrator%run(state)
  call expect_near(state%x(1), cos(1.0_hooke_real), 1e-12_hooke_real, "slow")
  call expect_near(state%x(2), cos(2.0_hooke_real), 1e-11_hooke_real, "fast")
  call expect_near(state%dx(2), -2*sin(2.0_hooke_real), 1e-11_hooke_real, "and its velocity")

  force%stop_value = 6
  call state%create_second_order(2)
  call integrator%run(state, status)
  call expect(status == hooke_stopped .and. integrator%stop_value() == 6, "the force stopped it")

  call make_run(run, "implicit-midpoint", 1e-3_hooke_real, 1.0_hooke_real)
  call integrator%create_second_order(1, known, 1.0_hooke_real, run)
  call state%create_second_order(1)
  state%x = 1
  call integrator%run(state)
  call expect_near(state%x(1), cos(1.0_hooke_real), 1e-6_hooke_real, "implicit")
  call expect(known%products > 0, "by the derivative")

  call integrator%create_second_order(1, force, [0.0_hooke_real], run, status)
  call expect(status == hooke_bad_value, "an inverse mass of 0 is refused")
  call finish()
end program
