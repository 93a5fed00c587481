! The system: particles, springs and forces. It is built, committed, and then only queried.
!
! Arrays of positions, velocities and forces are (3, n). Pointers are to the library's memory, for reading.
module hooke_systems
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use hooke_base, only: accept, is_3_by, to_c, zero_based
  use hooke_c_integrator, only: c_method_count
  use hooke_c_measurement, only: c_step_bound
  use hooke_c_system
  use hooke_handles, only: missing
  use hooke_queries_of_system
  implicit none
  private
  public :: hooke_system, rows_hold

  type, extends(hooke_system_queries) :: hooke_system
  contains
    procedure :: body_particles
    procedure :: body_inertia
    procedure :: body_motion
    procedure :: derivative_blocks
    procedure :: step_bound
    procedure :: step_bounds
  end type

contains

  ! Holds the arrays of a force by their `q` beyond the call (`more` 1), or releases them (-1); how often they are held.
  integer function rows_hold(q, more)
    real(c_double), intent(in), contiguous :: q(:, :)
    integer, intent(in) :: more
    rows_hold = int(c_rows_hold(q, int(more, c_int32_t)))
  end function

  ! The particles of rigid body number `body`.
  function body_particles(self, body) result(particles)
    class(hooke_system), intent(in) :: self
    integer, intent(in) :: body
    integer, allocatable :: particles(:)
    integer(c_int64_t), allocatable :: numbers(:)
    integer(c_int64_t) :: count
    count = c_system_body_particles(self%address(), zero_based(body))
    allocate (numbers(count), source=0_c_int64_t)
    count = c_system_body_particles(self%address(), zero_based(body), numbers)
    particles = int(numbers) + 1
  end function

  ! Its mass [kg] and moments of inertia [kg m^2] about the axes through its point, ascending.
  subroutine body_inertia(self, body, mass, inertia, status)
    class(hooke_system), intent(in) :: self
    integer, intent(in) :: body
    real(c_double), intent(out) :: mass, inertia(3)
    integer, intent(out), optional :: status
    real(c_double) :: numbers(4)
    numbers = 0.0_c_double
    if (.not. missing(status, self)) call accept(c_system_body_inertia(self%address(), zero_based(body), numbers), status)
    mass = numbers(1)
    inertia = numbers(2:4)
  end subroutine

  ! Its motion at q(3, n) and v(3, n): its point [m], the quaternion from its axes to those of space (real part first),
  ! the velocity of the point [m/s], the angular momentum about the point [kg m^2/s].
  subroutine body_motion(self, body, q, v, point, quaternion, velocity, angular_momentum, status)
    class(hooke_system), intent(in) :: self
    integer, intent(in) :: body
    real(c_double), intent(in), contiguous :: q(:, :), v(:, :)
    real(c_double), intent(out) :: point(3), quaternion(4), velocity(3), angular_momentum(3)
    integer, intent(out), optional :: status
    real(c_double) :: numbers(13)
    numbers = 0.0_c_double
    if (suits(self, status, q, v)) call accept(c_system_body_motion(self%address(), zero_based(body), q, v, numbers), status)
    point = numbers(1:3)
    quaternion = numbers(4:7)
    velocity = numbers(8:10)
    angular_momentum = numbers(11:13)
  end subroutine

  ! Whether arrays have the shape (3, n); without an argument `status` they must have it.
  logical function suits(self, status, first, second)
    class(hooke_system), intent(in) :: self
    integer, intent(out), optional :: status
    real(c_double), intent(in) :: first(:, :)
    real(c_double), intent(in), optional :: second(:, :)
    suits = .not. missing(status, self)
    if (suits) suits = is_3_by(first, int(self%particle_count(), c_int64_t), status)
    if (suits) suits = is_3_by(second, int(self%particle_count(), c_int64_t), status)
  end function

  ! dfdq(i, j, k) is the derivative of the force's component i by the position's component j, in block k; and dfdv by
  ! velocity. Callbacks are left out.
  subroutine derivative_blocks(self, q, v, dfdq, dfdv, status)
    class(hooke_system), intent(in) :: self
    real(c_double), intent(in), contiguous :: q(:, :), v(:, :)
    real(c_double), allocatable, intent(out) :: dfdq(:, :, :), dfdv(:, :, :)
    integer, intent(out), optional :: status
    integer :: k
    if (.not. suits(self, status, q, v)) return
    allocate (dfdq(3, 3, self%count("blocks")), source=0.0_c_double)
    dfdv = dfdq
    call accept(c_system_derivative_blocks(self%address(), q, v, dfdq, dfdv), status)
    do k = 1, size(dfdq, 3) ! C has rows of them
      dfdq(:, :, k) = transpose(dfdq(:, :, k))
      dfdv(:, :, k) = transpose(dfdv(:, :, k))
    end do
  end subroutine

  ! A step [s] below which `method` is certain to be stable at q.
  subroutine step_bound(self, method, q, bound, status)
    class(hooke_system), intent(in) :: self
    character(*), intent(in) :: method
    real(c_double), intent(in), contiguous :: q(:, :)
    real(c_double), intent(out) :: bound
    integer, intent(out), optional :: status
    real(c_double) :: found(1)
    bound = 0
    if (.not. suits(self, status, q)) return
    found = 0
    call accept(c_step_bound(self%address(), to_c(method), q, found), status)
    bound = found(1)
  end subroutine

  ! The same for every method, in the order of hooke_method_name().
  subroutine step_bounds(self, q, bounds, status)
    class(hooke_system), intent(in) :: self
    real(c_double), intent(in), contiguous :: q(:, :)
    real(c_double), allocatable, intent(out) :: bounds(:)
    integer, intent(out), optional :: status
    character(:), allocatable :: every
    allocate (bounds(c_method_count()), source=0.0_c_double)
    if (.not. suits(self, status, q)) return
    call accept(c_step_bound(self%address(), every, q, bounds), status)
  end subroutine

end module
