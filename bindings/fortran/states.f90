! State of a motion: time, positions and velocities, in the library's memory.
module hooke_states
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int64_t, c_ptr
  use hooke_c_state, only: c_state_position, c_state_velocity
  use hooke_queries_of_state
  implicit none
  private
  public :: hooke_state

  ! q(3, n) [m] and v(3, n) [m/s], for reading and, except in an observer, for writing. x and dx are q and v
  ! as lists; a first-order problem has x alone; of a second-order problem take x and dx. The pointers are valid as
  ! long as the state exists.
  type, extends(hooke_state_queries) :: hooke_state
    real(c_double), pointer, contiguous :: q(:, :) => null(), v(:, :) => null(), x(:) => null(), dx(:) => null()
  contains
    procedure :: refresh
  end type

contains

  subroutine refresh(self)
    class(hooke_state), intent(inout) :: self
    type(c_ptr) :: q, v
    integer(c_int64_t) :: size
    self%q => null()
    self%v => null()
    self%x => null()
    self%dx => null()
    if (.not. self%exists()) return
    size = self%size()
    q = c_state_position(self%address())
    v = c_state_velocity(self%address())
    call c_f_pointer(q, self%x, [size])
    if (.not. c_associated(v)) return
    call c_f_pointer(v, self%dx, [size])
    call c_f_pointer(q, self%q, [3_c_int64_t, size/3])
    call c_f_pointer(v, self%v, [3_c_int64_t, size/3])
  end subroutine

end module
