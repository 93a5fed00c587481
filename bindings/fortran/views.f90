! A trajectory as one HTML page that plays it.
module hooke_views
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use hooke_base, only: accept, to_c, to_c_if
  use hooke_c_measurement, only: c_measurement_label, c_measurement_write
  use hooke_handles, only: missing
  use hooke_queries_of_view
  implicit none
  private
  public :: hooke_view

  type, extends(hooke_view_queries) :: hooke_view
  contains
    procedure :: write => write_page
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
    if (missing(status, self)) return
    call to_c_if(title, c_title)
    code = c_measurement_label(self%address(), to_c("title"), c_title)
    if (code == 0) code = c_measurement_write(self%address(), to_c(path))
    call accept(code, status)
  end subroutine

end module
