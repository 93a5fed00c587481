! A trajectory as one HTML page that plays it.
module hooke_views
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use hooke_base, only: accept, to_c, to_c_if
  use hooke_c_measurement, only: c_measurement_label, c_measurement_number, c_measurement_write
  use hooke_queries_of_view
  implicit none
  private
  public :: hooke_view

  type, extends(hooke_view_queries) :: hooke_view
  contains
    procedure :: write => write_page
    procedure :: number
  end type

contains

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

end module
