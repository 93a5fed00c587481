! Statuses, messages, kinds, facts about the build; and conversion of text and numbers for C.
module hooke_base
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_int32_t, c_int64_t, &
    c_null_char, c_ptr, c_size_t
  use hooke_c_base, only: c_last_error, c_status_name, hooke_bad_value
  implicit none
  private
  public :: hooke_real, hooke_long
  public :: last_error, status_name ! hooke_message() and hooke_status_name() for users
  public :: accept, refuse, stop_with, to_text, to_c, to_integer, to_list, to_number, to_series
  public :: zero_based, is_3_by

  ! Kinds of all real numbers, and of counts that may not fit a default integer (steps, bytes).
  integer, parameter :: hooke_real = c_double, hooke_long = c_int64_t

  ! The last message of this module itself, in this thread; "" if the library's is newer.
  character(400), save :: refusal = ""
  !$omp threadprivate(refusal)

  ! One number or several as a list for C, where particles and the like count from 0.
  interface to_list
    procedure :: to_list_of_reals, to_list_of_indices
  end interface

  interface
    integer(c_size_t) function strlen(text) bind(c)
      import
      type(c_ptr), value :: text
    end function
  end interface

contains

  ! The message of the last failure or outcome in this thread; "" if there was none.
  function last_error() result(text)
    character(:), allocatable :: text
    text = trim(refusal)
    if (text == "") text = to_text(c_last_error())
  end function

  ! Short name of a status, such as "bad value".
  function status_name(status) result(text)
    integer, intent(in) :: status
    character(:), allocatable :: text
    text = to_text(c_status_name(int(status, c_int32_t)))
  end function

  ! ---- for the other modules ----

  ! Returns the status of a call; without an argument `status` a non-zero one ends the program.
  subroutine accept(code, status)
    integer(c_int32_t), intent(in) :: code
    integer, intent(out), optional :: status
    refusal = ""
    if (present(status)) then
      status = int(code)
    else if (code /= 0) then
      call stop_with(status_name(int(code)) // ": " // last_error())
    end if
  end subroutine

  ! A failure that is detected before the library is called.
  subroutine refuse(code, text, status)
    integer, intent(in) :: code
    character(*), intent(in) :: text
    integer, intent(out), optional :: status
    if (.not. present(status)) call stop_with(text)
    refusal = text
    status = code
  end subroutine

  subroutine stop_with(text)
    character(*), intent(in) :: text
    error stop "hooke: " // text
  end subroutine

  ! Text of the library as Fortran text; "" for NULL.
  function to_text(address) result(text)
    type(c_ptr), intent(in) :: address
    character(:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    text = ""
    if (.not. c_associated(address)) return
    call c_f_pointer(address, letters, [strlen(address)])
    text = repeat(" ", size(letters))
    text = transfer(letters, text)
  end function

  pure function to_c(text) result(terminated)
    character(*), intent(in) :: text
    character(len_trim(text) + 1, kind=c_char) :: terminated
    terminated = trim(text) // c_null_char
  end function

  integer function to_integer(count)
    integer(c_int64_t), intent(in) :: count
    if (count > huge(to_integer)) call stop_with("a count is too large for a default integer")
    to_integer = int(count)
  end function

  ! The index of a particle, spring, row or frame in C.
  elemental integer(c_int64_t) function zero_based(number)
    integer, intent(in) :: number
    zero_based = int(number, c_int64_t) - 1
  end function

  subroutine to_list_of_reals(numbers, list)
    real(c_double), intent(in) :: numbers(..)
    real(c_double), allocatable, intent(out) :: list(:)
    select rank (numbers)
    rank (0)
      list = [numbers]
    rank (1)
      list = [numbers]
    rank default
      call stop_with("one number or a list of them is needed, and not an array of more dimensions")
    end select
  end subroutine

  subroutine to_list_of_indices(numbers, list)
    integer, intent(in) :: numbers(..)
    integer(c_int64_t), allocatable, intent(out) :: list(:)
    select rank (numbers)
    rank (0)
      list = [zero_based(numbers)]
    rank (1)
      list = [zero_based(numbers)]
    rank default
      call stop_with("one number or a list of them is needed, and not an array of more dimensions")
    end select
  end subroutine

  ! A number by name: indices of particles, springs and groups count from 1 here.
  real(c_double) function to_number(value, what)
    real(c_double), intent(in) :: value
    character(*), intent(in) :: what
    to_number = value
    select case (what)
    case ("particle", "spring", "number", "first", "second", "group")
      to_number = value + 1
    end select
  end function

  ! `count` numbers in the library's memory; not associated for NULL.
  function to_series(address, count) result(series)
    type(c_ptr), intent(in) :: address
    integer(c_int64_t), intent(in) :: count
    real(c_double), pointer, contiguous :: series(:)
    series => null()
    if (c_associated(address)) call c_f_pointer(address, series, [count])
  end function

  ! Whether an array has 3 numbers for each of `count` things; without an argument `status` it must.
  logical function is_3_by(array, count, status)
    real(c_double), intent(in) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    integer, intent(out), optional :: status
    character(20) :: n
    is_3_by = size(array, 1) == 3 .and. size(array, 2, c_int64_t) == count
    if (is_3_by) return
    write (n, "(i0)") count
    call refuse(hooke_bad_value, "an array has not the shape (3, n), n = " // n, status)
  end function
end module
