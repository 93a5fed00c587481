! State of a motion: time, positions and velocities, in the library's memory.
module hooke_states
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int32_t, c_int64_t, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_integer
  use hooke_c_state
  use hooke_queries_of_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_state

  ! q(3, n) [m] and v(3, n) [m/s], for reading and, except in an observer, for writing. x and dx are q and v
  ! as lists; a first-order problem has x alone; of a second-order problem take x and dx. The pointers are valid as
  ! long as the state exists.
  type, extends(hooke_state_queries) :: hooke_state
    real(c_double), pointer, contiguous :: q(:, :) => null(), v(:, :) => null(), x(:) => null(), dx(:) => null()
  contains
    procedure :: create
    procedure :: create_first_order
    procedure :: create_second_order
    procedure :: copy_to
    procedure :: size => size_of
    procedure :: look_at
    procedure :: destroy
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! Takes a state that was made with this code.
  subroutine begin(self, state, code, status)
    class(hooke_state), intent(inout) :: self
    type(c_ptr), intent(in) :: state
    integer(c_int32_t), intent(in) :: code
    integer, intent(out), optional :: status
    if (code == 0) then
      call self%take(state, c_state_destroy)
      call point(self)
    end if
    call accept(code, status)
  end subroutine

  ! The initial state of a committed system.
  subroutine create(self, system, status)
    class(hooke_state), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    integer, intent(out), optional :: status
    type(c_ptr) :: state
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    code = c_state_create(system%address(), state)
    call begin(self, state, code, status)
  end subroutine

  ! `size` zeros for x' = phi(t, x).
  subroutine create_first_order(self, size, status)
    class(hooke_state), intent(inout) :: self
    integer, intent(in) :: size
    integer, intent(out), optional :: status
    type(c_ptr) :: state
    integer(c_int32_t) :: code
    code = c_state_create_first_order(int(size, c_int64_t), state)
    call begin(self, state, code, status)
  end subroutine

  ! `size` zeros for q'' = W f(t, q, v), and as many velocities.
  subroutine create_second_order(self, size, status)
    class(hooke_state), intent(inout) :: self
    integer, intent(in) :: size
    integer, intent(out), optional :: status
    type(c_ptr) :: state
    integer(c_int32_t) :: code
    code = c_state_create_second_order(int(size, c_int64_t), state)
    call begin(self, state, code, status)
  end subroutine

  ! Copies t, q and v into another state of the same size.
  subroutine copy_to(self, other, status)
    class(hooke_state), intent(in) :: self
    class(hooke_state), intent(inout) :: other
    integer, intent(out), optional :: status
    if (self%is_missing(status, other)) return
    call accept(c_state_copy(self%address(), other%address()), status)
  end subroutine

  ! Number of numbers in q: 3n, or the size of a first- or second-order problem.
  integer function size_of(self)
    class(hooke_state), intent(in) :: self
    size_of = to_integer(c_state_size(self%address()))
  end function

  ! Refers to a state of the library's during a callback; NULL ends it.
  subroutine look_at(self, state)
    class(hooke_state), intent(inout) :: self
    type(c_ptr), intent(in) :: state
    call self%lend(state)
    call point(self)
  end subroutine

  subroutine destroy(self)
    class(hooke_state), intent(inout) :: self
    call self%hooke_handle%destroy()
    call point(self)
  end subroutine

  subroutine point(self)
    class(hooke_state), intent(inout) :: self
    type(c_ptr) :: q, v
    integer(c_int64_t) :: size
    self%q => null()
    self%v => null()
    self%x => null()
    self%dx => null()
    if (.not. self%exists()) return
    size = c_state_size(self%address())
    q = c_state_position(self%address())
    v = c_state_velocity(self%address())
    call c_f_pointer(q, self%x, [size])
    if (.not. c_associated(v)) return
    call c_f_pointer(v, self%dx, [size])
    call c_f_pointer(q, self%q, [3_c_int64_t, size/3])
    call c_f_pointer(v, self%v, [3_c_int64_t, size/3])
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_state), intent(inout) :: self
    type(hooke_state), intent(in) :: other
    call self%share(other)
    call point(self)
  end subroutine
end module
