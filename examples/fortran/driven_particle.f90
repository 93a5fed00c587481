! Driven particles: one end of a rope is shaken by a procedure, the other by a sine.
module motions
  use hooke
  implicit none

  ! A circle about where the particle was, taken up over the first second.
  type, extends(hooke_drive) :: circle
    real(hooke_real) :: centre(3) = 0, radius = 0, omega = 0 ! m, m, rad/s
  contains
    procedure :: move
  end type

contains

  subroutine move(self, n, t, q, v, stop_value)
    class(circle), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t
    real(hooke_real), intent(out) :: q(3, n), v(3, n)
    integer, intent(inout) :: stop_value
    real(hooke_real) :: r, dr, c, s
    r = self%radius*min(t, 1.0_hooke_real)**2
    dr = merge(2*self%radius*t, 0.0_hooke_real, t < 1)
    c = cos(self%omega*t)
    s = sin(self%omega*t)
    q = spread(self%centre + r*[0.0_hooke_real, c, s], 2, n)
    v = spread(dr*[0.0_hooke_real, c, s] + r*self%omega*[0.0_hooke_real, -s, c], 2, n)
  end subroutine
end module

program driven_particle
  use hooke
  use motions
  implicit none
  type(circle), target :: hand
  type(hooke_system) :: system
  type(hooke_options) :: rope, run
  type(hooke_integrator) :: integrator
  type(hooke_state) :: state
  real(hooke_real), parameter :: pi = acos(-1.0_hooke_real)
  integer :: first, count

  call rope%create("rope")
  call rope%set("from", [0, 0, 0])
  call rope%set("to", [2, 0, 0])
  call rope%set("segments", 32)
  call rope%set("mass", 0.25_hooke_real)
  call rope%set("stretch.stiffness", 500)
  call rope%set("stretch.damping", 0.1_hooke_real)
  call system%create()
  call system%add_part("rope", rope, first=first, count=count)
  hand = circle(radius=0.1_hooke_real, omega=2*pi)
  call system%drive_callback([first], hand)
  call system%drive_harmonic([first + count - 1], [0.05_hooke_real, 0.0_hooke_real, 0.0_hooke_real], &
    frequency=0.5_hooke_real)
  call system%commit()

  call run%create("run")
  call run%set("method", "verlet")
  call run%set("step", 1e-4_hooke_real)
  call run%set("duration", 2)
  call integrator%create(system, run)
  call state%create(system)
  call integrator%run(state)
  print "(a, 3(1x, f0.4), a)", "the hand is at", state%q(:, first), " m"
  print "(a, f0.4, a)", "the middle of the rope is off by ", norm2(state%q(2:3, count/2)), " m"
end program
