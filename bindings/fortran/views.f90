! A trajectory as one HTML page that plays it.
module hooke_views
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_ptr
  use hooke_base, only: accept, to_c, to_c_if
  use hooke_c_io, only: c_view_create, c_view_destroy, c_view_number, c_view_write
  use hooke_handles, only: hooke_handle
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_trajectories, only: hooke_record
  implicit none
  private
  public :: hooke_view

  type, extends(hooke_handle) :: hooke_view
  contains
    procedure :: create
    procedure :: write => write_page
    procedure :: number
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! Chooses what of the file is shown.
  subroutine create(self, record, options, status)
    class(hooke_view), intent(inout) :: self
    class(hooke_record), intent(in) :: record
    type(hooke_options), intent(in), optional :: options
    integer, intent(out), optional :: status
    type(c_ptr) :: view
    integer(c_int32_t) :: code
    if (record%is_missing(status)) return
    code = c_view_create(record%address(), options_or_null(options), view)
    if (code == 0) call self%take(view, c_view_destroy, record)
    call accept(code, status)
  end subroutine

  ! Writes the page, with `title` over it.
  subroutine write_page(self, path, title, status)
    class(hooke_view), intent(inout) :: self
    character(*), intent(in) :: path
    character(*), intent(in), optional :: title
    integer, intent(out), optional :: status
    character(:), allocatable :: c_title
    if (self%is_missing(status)) return
    call to_c_if(title, c_title)
    call accept(c_view_write(self%address(), to_c(path), c_title), status)
  end subroutine

  ! "frames", "springs", "particles" that are shown, "strain", "bytes" and more; NaN for another word.
  real(c_double) function number(self, what)
    class(hooke_view), intent(in) :: self
    character(*), intent(in) :: what
    number = c_view_number(self%address(), to_c(what))
  end function

  impure elemental subroutine assign(self, other)
    class(hooke_view), intent(inout) :: self
    type(hooke_view), intent(in) :: other
    call self%share(other)
  end subroutine
end module
