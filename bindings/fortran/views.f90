! A trajectory as one HTML page that plays it.
module hooke_views
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_ptr
  use hooke_base, only: accept, to_c, to_c_if
  use hooke_c_measurement, only: c_measurement_destroy, c_measurement_label, c_measurement_number, c_measurement_write
  use hooke_c_trajectory, only: c_view_add, c_view_create
  use hooke_handles, only: hooke_handle
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_trajectories, only: hooke_record
  implicit none
  private
  public :: hooke_view

  type, extends(hooke_handle) :: hooke_view
  contains
    procedure :: create
    procedure :: add
    procedure :: write => write_page
    procedure :: number
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! Selects the frames and springs that are shown.
  subroutine create(self, record, options, status)
    class(hooke_view), intent(inout) :: self
    class(hooke_record), intent(in) :: record
    type(hooke_options), intent(in), optional :: options
    integer, intent(out), optional :: status
    type(c_ptr) :: view
    integer(c_int32_t) :: code
    if (record%is_missing(status)) return
    code = c_view_create(record%address(), options_or_null(options), view)
    if (code == 0) call self%take(view, c_measurement_destroy, record)
    call accept(code, status)
  end subroutine

  ! Shows another one beside it on its page; that one has to live until the page is written.
  subroutine add(self, other, status)
    class(hooke_view), intent(inout) :: self
    class(hooke_view), intent(in) :: other
    integer, intent(out), optional :: status
    if (self%is_missing(status, other)) return
    call accept(c_view_add(self%address(), other%address()), status)
  end subroutine

  ! Writes the page; without a `title` its heading is that of the scene.
  subroutine write_page(self, path, title, status)
    class(hooke_view), intent(inout) :: self
    character(*), intent(in) :: path
    character(*), intent(in), optional :: title
    integer, intent(out), optional :: status
    character(:), allocatable :: c_title
    integer(c_int32_t) :: code
    if (self%is_missing(status)) return
    call to_c_if(title, c_title)
    code = c_measurement_label(self%address(), to_c("title"), c_title)
    if (code == 0) code = c_measurement_write(self%address(), to_c(path))
    call accept(code, status)
  end subroutine

  ! "frames", "springs" and the other numbers of the table of a view.
  real(c_double) function number(self, what)
    class(hooke_view), intent(in) :: self
    character(*), intent(in) :: what
    number = c_measurement_number(self%address(), to_c("view"), 0_c_int64_t, to_c(what))
  end function

  impure elemental subroutine assign(self, other)
    class(hooke_view), intent(inout) :: self
    type(hooke_view), intent(in) :: other
    call self%share(other)
  end subroutine
end module
