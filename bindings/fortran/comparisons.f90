! One scene by several methods, against CVODE at tight tolerance.
module hooke_comparisons
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_int32_t, c_loc, c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_c, to_integer, to_series, to_text, zero_based
  use hooke_c_measure
  use hooke_handles, only: hooke_handle
  use hooke_observers, only: call_comparison_observer, call_progress, comparison_holder, hooke_comparison_observer, &
    hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_comparison

  integer, parameter :: of_progress = 1, of_frames = 2

  type, extends(hooke_handle) :: hooke_comparison
  contains
    procedure :: create
    procedure :: add
    procedure :: on_progress
    procedure :: on_frame
    procedure :: run
    procedure :: row_count
    procedure :: text
    procedure :: number
    procedure :: reference
    procedure :: frame_count
    procedure :: series
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! `options` are those of a run: step, duration, every, rtol and atol.
  subroutine create(self, system, options, status)
    class(hooke_comparison), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in) :: options
    integer, intent(out), optional :: status
    type(c_ptr) :: comparison
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    if (options%is_missing(status)) return
    code = c_comparison_create(system%address(), options%address(), comparison)
    if (code == 0) call self%take(comparison, c_comparison_destroy, system)
    call accept(code, status)
  end subroutine

  ! Adds a method as a row; without any call all methods are compared.
  subroutine add(self, method, status)
    class(hooke_comparison), intent(inout) :: self
    character(*), intent(in) :: method
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_comparison_add(self%address(), to_c(method)), status)
  end subroutine

  ! Told of progress; has to stay where it is as long as it is. Without one it is taken back.
  subroutine on_progress(self, progress)
    class(hooke_comparison), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(progress_holder), pointer :: holder
    if (.not. present(progress)) then
      call c_comparison_on_progress(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%progress => progress
    call c_comparison_on_progress(self%address(), c_funloc(call_progress), c_loc(holder))
    call self%keep(holder, of_progress)
  end subroutine

  ! Sees the frames of all runs; the same holds.
  subroutine on_frame(self, observer)
    class(hooke_comparison), intent(inout) :: self
    class(hooke_comparison_observer), target, intent(inout), optional :: observer
    type(comparison_holder), pointer :: holder
    if (.not. present(observer)) then
      call c_comparison_on_frame(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%observer => observer
    call c_comparison_on_frame(self%address(), c_funloc(call_comparison_observer), c_loc(holder))
    call self%keep(holder, of_frames)
  end subroutine

  ! Runs the reference, then every row.
  subroutine run(self, status)
    class(hooke_comparison), intent(inout) :: self
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_comparison_run(self%address()), status)
  end subroutine

  integer function row_count(self)
    class(hooke_comparison), intent(in) :: self
    row_count = to_integer(c_comparison_row_count(self%address()))
  end function

  ! "method" and "status" of a row; "" if there is none.
  function text(self, row, what)
    class(hooke_comparison), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_comparison_text(self%address(), zero_based(row), to_c(what)))
  end function

  ! A number of a row by its name ("error", "steps", ...), NaN where it does not apply.
  real(c_double) function number(self, row, what)
    class(hooke_comparison), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    number = c_comparison_number(self%address(), zero_based(row), to_c(what))
  end function

  ! The method that gave the reference.
  function reference(self) result(text)
    class(hooke_comparison), intent(in) :: self
    character(:), allocatable :: text
    text = to_text(c_comparison_reference(self%address()))
  end function

  integer function frame_count(self)
    class(hooke_comparison), intent(in) :: self
    frame_count = to_integer(c_comparison_frame_count(self%address()))
  end function

  ! "time", "error" and "energy_drift" of a row over the frames; not associated for another word.
  function series(self, row, what)
    class(hooke_comparison), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    real(c_double), pointer, contiguous :: series(:)
    series => to_series(c_comparison_series(self%address(), zero_based(row), to_c(what)), &
      c_comparison_frame_count(self%address()))
  end function

  impure elemental subroutine assign(self, other)
    class(hooke_comparison), intent(inout) :: self
    type(hooke_comparison), intent(in) :: other
    call self%share(other)
  end subroutine
end module
