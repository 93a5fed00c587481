! A force of one's own: wind drags at every particle of a rope.
module winds
  use hooke
  implicit none

  type, extends(hooke_force_with_product) :: wind
    real(hooke_real) :: velocity(3) = 0, coefficient = 0 ! m/s, N s/m
  contains
    procedure :: add
    procedure :: add_product
  end type

contains

  subroutine add(self, n, t, q, v, force, stop_value)
    class(wind), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, q(3, n), v(3, n)
    real(hooke_real), intent(inout) :: force(3, n)
    integer, intent(inout) :: stop_value ! anything but 0 stops the run
    integer :: k
    do k = 1, n
      force(:, k) = force(:, k) + self%coefficient*(self%velocity - v(:, k))
    end do
  end subroutine

  ! Its derivative times (dq, dv), which spares methods that need it difference quotients.
  subroutine add_product(self, n, t, q, v, dq, dv, out, stop_value)
    class(wind), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, q(3, n), v(3, n), dq(3, n), dv(3, n)
    real(hooke_real), intent(inout) :: out(3, n)
    integer, intent(inout) :: stop_value
    out = out - self%coefficient*dv
  end subroutine
end module

program own_force
  use hooke
  use winds
  implicit none
  type(wind), target :: breeze ! `target`: the system points to it
  type(hooke_system) :: system
  type(hooke_options) :: rope, run
  type(hooke_integrator) :: integrator
  type(hooke_state) :: state

  call rope%create("rope")
  call rope%set("from", [0, 0, 0])
  call rope%set("to", [1, 0, 0])
  call rope%set("segments", 24)
  call rope%set("mass", 0.25_hooke_real)              ! kg
  call rope%set("pinned", "start")
  call rope%set("stretch.stiffness", 200)             ! N
  call rope%set("stretch.damping", 0.05_hooke_real)   ! N s
  call system%create()
  call system%add_part("rope", rope)
  call system%set_gravity([0.0_hooke_real, -9.81_hooke_real, 0.0_hooke_real])
  breeze = wind(velocity=[0.0_hooke_real, 0.0_hooke_real, 3.0_hooke_real], coefficient=0.002_hooke_real)
  call system%set_force(breeze)
  call system%commit()

  call run%create("run")
  call run%set("method", "rk4")
  call run%set("step", 1e-3_hooke_real)
  call run%set("duration", 1)
  call integrator%create(system, run)
  call state%create(system)
  call integrator%run(state)
  print "(a, f0.3, a)", "after 1 s the wind has the end of the rope at z = ", state%q(3, 25), " m"
end program
