! A trajectory as one HTML page that plays it.
module hooke_views
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_ptr
  use hooke_base, only: accept, to_c, to_c_if
  use hooke_c_trajectory, only: c_view_create, c_view_destroy, c_view_number, c_view_write
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_trajectories, only: hooke_record
  use hooke_queries_of_view
  implicit none
  private
  public :: hooke_view

  type, extends(hooke_view_queries) :: hooke_view
  contains
    procedure :: create
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
    if (code == 0) call self%take(view, c_view_destroy, record)
    call accept(code, status)
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_view), intent(inout) :: self
    type(hooke_view), intent(in) :: other
    call self%share(other)
  end subroutine
end module
