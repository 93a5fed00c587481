! Forward Euler on flows of two components, x' = phi(t, x): a leaf in a river, a spiral and van der Pol's oscillator.
module flows
  use hooke
  implicit none
  type, extends(hooke_rate) :: flow
    character(16) :: name
  contains
    procedure :: evaluate => rate_of
  end type
contains
  subroutine rate_of(self, n, t, x, rate, stop_value)
    class(flow), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, x(n)
    real(hooke_real), intent(out) :: rate(n)
    integer, intent(inout) :: stop_value
    if (n /= 2 .or. t < 0) stop_value = 1
    select case (self%name)
    case ("river")
      rate = [1.0_hooke_real, cos(x(1)) - (x(2) - sin(x(1)))/2]
    case ("linear")
      rate = [-0.2_hooke_real*x(1) - 2*x(2), 2*x(1) - 0.2_hooke_real*x(2)]
    case ("van-der-pol")
      rate = [x(2), (1 - x(1)**2)*x(2) - x(1)]
    end select
  end subroutine
end module

program river
  use flows
  implicit none
  character(16), parameter :: names(3) = [character(16) :: "river", "linear", "van-der-pol"]
  real(hooke_real), parameter :: start(2, 3) = reshape([0.0_hooke_real, 1.0_hooke_real, 1.0_hooke_real, 0.0_hooke_real, &
    0.5_hooke_real, 0.0_hooke_real], [2, 3])
  integer :: k
  do k = 1, 3
    call run(k)
  end do
contains
  subroutine run(k)
    integer, intent(in) :: k
    type(flow), target :: phi
    type(hooke_options) :: options
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    phi%name = names(k)
    call options%create("run")
    call options%set("method", "forward-euler")
    call options%set("step", 0.5_hooke_real)
    call integrator%create_first_order(2, phi, options)
    call state%create_first_order(2)
    state%x = start(:, k)
    call integrator%step(state, 12)
    print "(a, 2f18.12)", names(k), state%x
  end subroutine
end program
