! Callbacks shared by the tests.
module parts
  use hooke
  implicit none

  ! Gravity, for the given masses.
  type, extends(hooke_force) :: weight
    real(hooke_real) :: g(3) = 0
    real(hooke_real), allocatable :: mass(:)
    integer :: calls = 0, stop_after = -1, held = 0
  contains
    procedure :: add => add_weight
  end type

  ! Drag against a wind, with its derivative.
  type, extends(hooke_force_with_product) :: wind
    real(hooke_real) :: velocity(3) = 0, coefficient = 0
    integer :: calls = 0, products = 0
  contains
    procedure :: add => add_wind
    procedure :: add_product => add_wind_product
  end type

  ! A sine along x for every particle.
  type, extends(hooke_drive) :: sine
    real(hooke_real), allocatable :: start(:, :)
    real(hooke_real) :: amplitude = 0, omega = 0, stop_at = huge(0.0_hooke_real)
  contains
    procedure :: move => move_by_sine
  end type

  ! x' = (-x(2), x(1))
  type, extends(hooke_rate) :: turn
    integer :: stop_value = 0
    real(hooke_real) :: stop_at = huge(0.0_hooke_real)
  contains
    procedure :: evaluate => evaluate_turn
  end type

  ! Records its calls, and stops at a step.
  type, extends(hooke_observer) :: watcher
    integer :: seen = 0
    integer(hooke_long) :: last = -1, stop_at = huge(0_hooke_long)
    real(hooke_real) :: time = 0, q(3) = 0
    type(hooke_state) :: kept
  contains
    procedure :: see => watch
  end type

  type, extends(hooke_progress) :: teller
    integer :: told = 0, stop_after = huge(0)
    real(hooke_real) :: done = -1
    character(:), allocatable :: what
  contains
    procedure :: tell
  end type

  type, extends(hooke_warning) :: warner
    integer :: warnings = 0, spring = -1, particle = -1
    real(hooke_real) :: limit = 0
    character(:), allocatable :: kind, sentence
  contains
    procedure :: warn
  end type

contains

  subroutine add_weight(self, n, t, q, v, force, stop_value)
    class(weight), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, q(3, n), v(3, n)
    real(hooke_real), intent(inout) :: force(3, n)
    integer, intent(inout) :: stop_value
    integer :: k
    do k = 1, n
      force(:, k) = force(:, k) + self%mass(k)*self%g
    end do
    self%calls = self%calls + 1
    self%held = hooke_rows_hold(q, 1)
    if (hooke_rows_hold(q, -1) /= 1) self%held = -1
    if (self%calls == self%stop_after) stop_value = 7
    if (t < 0 .or. any(isnan_of(q)) .or. any(isnan_of(v))) stop_value = 8
  end subroutine

  elemental logical function isnan_of(x)
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    real(hooke_real), intent(in) :: x
    isnan_of = ieee_is_nan(x)
  end function

  subroutine add_wind(self, n, t, q, v, force, stop_value)
    class(wind), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, q(3, n), v(3, n)
    real(hooke_real), intent(inout) :: force(3, n)
    integer, intent(inout) :: stop_value
    integer :: k
    do k = 1, n
      force(:, k) = force(:, k) + self%coefficient*(self%velocity - v(:, k))
    end do
    self%calls = self%calls + 1
    if (t < 0 .or. any(isnan_of(q))) stop_value = 8
  end subroutine

  subroutine add_wind_product(self, n, t, q, v, dq, dv, out, stop_value)
    class(wind), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, q(3, n), v(3, n), dq(3, n), dv(3, n)
    real(hooke_real), intent(inout) :: out(3, n)
    integer, intent(inout) :: stop_value
    out = out - self%coefficient*dv
    self%products = self%products + 1
    if (t < 0 .or. any(isnan_of(q)) .or. any(isnan_of(v)) .or. any(isnan_of(dq))) stop_value = 8
  end subroutine

  subroutine move_by_sine(self, n, t, q, v, stop_value)
    class(sine), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t
    real(hooke_real), intent(out) :: q(3, n), v(3, n)
    integer, intent(inout) :: stop_value
    q = self%start
    q(1, :) = q(1, :) + self%amplitude*sin(self%omega*t)
    v = 0
    v(1, :) = self%amplitude*self%omega*cos(self%omega*t)
    if (t > self%stop_at) stop_value = 5
  end subroutine

  subroutine evaluate_turn(self, n, t, x, rate, stop_value)
    class(turn), intent(inout) :: self
    integer, intent(in) :: n
    real(hooke_real), intent(in) :: t, x(n)
    real(hooke_real), intent(out) :: rate(n)
    integer, intent(inout) :: stop_value
    rate = 0
    rate(1) = -x(2)
    rate(2) = x(1)
    if (t > self%stop_at) stop_value = self%stop_value
  end subroutine

  subroutine watch(self, step, state, stop_value)
    class(watcher), intent(inout) :: self
    integer(hooke_long), intent(in) :: step
    type(hooke_state), intent(in) :: state
    integer, intent(inout) :: stop_value
    self%seen = self%seen + 1
    self%last = step
    self%time = state%time()
    self%q = state%q(:, size(state%q, 2))
    self%kept = state
    if (step >= self%stop_at) stop_value = 42
  end subroutine

  subroutine tell(self, done, what, stop_value)
    class(teller), intent(inout) :: self
    real(hooke_real), intent(in) :: done
    character(*), intent(in) :: what
    integer, intent(inout) :: stop_value
    self%told = self%told + 1
    self%done = done
    self%what = what
    if (self%told >= self%stop_after) stop_value = 3
  end subroutine

  subroutine warn(self, kind, sentence, t, limit, spring, particle, stop_value)
    class(warner), intent(inout) :: self
    character(*), intent(in) :: kind, sentence
    real(hooke_real), intent(in) :: t, limit
    integer, intent(in) :: spring, particle
    integer, intent(inout) :: stop_value
    self%warnings = self%warnings + 1
    self%kind = kind
    self%sentence = sentence
    self%limit = limit
    self%spring = spring
    self%particle = particle
    if (t < 0) stop_value = 1
  end subroutine
end module
