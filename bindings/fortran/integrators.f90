! Methods, and the loop that runs them.
module hooke_integrators
  use, intrinsic :: iso_c_binding, only: c_funloc, c_loc
  use hooke_base, only: accept
  use hooke_c_integrator, only: c_integrator_options, c_system_warnings
  use hooke_handles, only: called_object, missing
  use hooke_observers, only: call_warning, hooke_warning
  use hooke_option_tables, only: hooke_options
  use hooke_queries_of_integrator
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_integrator, hooke_system_warnings

  type, extends(hooke_integrator_queries) :: hooke_integrator
    ! Its own copy of its options, with defaults filled in.
    type(hooke_options) :: options
  contains
    procedure :: refresh
  end type

contains

  ! Warns of what a scene may be, but is seldom meant to be.
  subroutine hooke_system_warnings(system, warning, status)
    class(hooke_system), intent(in) :: system
    class(hooke_warning), target, intent(inout) :: warning
    integer, intent(out), optional :: status
    type(called_object), target :: called
    if (missing(status, system)) return
    called%it => warning
    call accept(c_system_warnings(system%address(), c_funloc(call_warning), c_loc(called)), status)
  end subroutine

  subroutine refresh(self)
    class(hooke_integrator), intent(inout) :: self
    call self%options%destroy()
    if (self%exists()) call self%options%take(c_integrator_options(self%address()), owner=self)
  end subroutine
end module
