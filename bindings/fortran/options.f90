! Named options, with their types, units, bounds and defaults.
module hooke_option_tables
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use hooke_base, only: to_c, to_series
  use hooke_c_options, only: c_options_numbers
  use hooke_queries_of_options
  implicit none
  private
  public :: hooke_options

  type, extends(hooke_options_queries) :: hooke_options
  contains
    procedure, private :: set_whole, set_wholes, set_logical
    generic :: set => set_numbers, set_whole, set_wholes, set_logical, set_text
    procedure :: numbers ! all of them
  end type

contains

  subroutine set_whole(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value
    integer, intent(out), optional :: status
    call self%set(name, real(value, c_double), status)
  end subroutine

  subroutine set_wholes(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value(:)
    integer, intent(out), optional :: status
    call self%set(name, real(value, c_double), status)
  end subroutine

  subroutine set_logical(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    logical, intent(in) :: value
    integer, intent(out), optional :: status
    call self%set(name, merge(1, 0, value), status)
  end subroutine

  function numbers(self, name) result(values)
    class(hooke_options), intent(in) :: self
    character(*), intent(in) :: name
    real(c_double), allocatable :: values(:)
    real(c_double), pointer, contiguous :: there(:)
    there => to_series(c_options_numbers(self%address(), to_c(name)), &
      int(self%number_count(name), c_int64_t))
    allocate (values(0))
    if (associated(there)) values = there
  end function

end module
