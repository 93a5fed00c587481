! The error of a run, and a method and a step or tolerance for a wanted error.
module hooke_estimates
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_int32_t, c_int64_t, c_loc, c_null_funptr, c_null_ptr, &
    c_ptr
  use hooke_base, only: accept, to_c, to_c_if, to_text
  use hooke_c_estimate
  use hooke_c_trajectory, only: c_estimate_write_h5
  use hooke_queries_of_estimate
  use hooke_integrators, only: hooke_integrator
  use hooke_observers, only: call_progress, hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_estimate

  integer, parameter :: of_progress = 1

  type, extends(hooke_estimate_queries) :: hooke_estimate
  contains
    procedure :: create
    procedure :: on_progress
    procedure :: pick
    procedure :: begin
    procedure :: see
    procedure :: measure
    procedure :: refine
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! `want` [m] is the error that no frame may exceed; NaN for none.
  subroutine create(self, system, want, status)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    real(c_double), intent(in) :: want
    integer, intent(out), optional :: status
    type(c_ptr) :: estimate
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    code = c_estimate_create(system%address(), want, estimate)
    if (code == 0) call self%take(estimate, c_estimate_destroy, system)
    call accept(code, status)
  end subroutine

  ! Sets the progress callback, which must exist as long as it is set; without an argument it is removed.
  subroutine on_progress(self, progress)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(progress_holder), pointer :: holder
    if (.not. present(progress)) then
      call c_estimate_on_progress(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%progress => progress
    call c_estimate_on_progress(self%address(), c_funloc(call_progress), c_loc(holder))
    call self%keep(holder, of_progress)
  end subroutine

  ! Sets a method (`method`, or any) and its step or tolerance in `run`.
  subroutine pick(self, run, method, status)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_options), intent(inout) :: run
    character(*), intent(in), optional :: method
    integer, intent(out), optional :: status
    character(:), allocatable :: c_method
    if (self%is_missing(status)) return
    call to_c_if(method, c_method)
    call accept(c_estimate_pick(self%address(), c_method, run%address()), status)
  end subroutine

  ! Call before a run of `integrator` from `state`.
  subroutine begin(self, integrator, state, status)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_integrator), intent(in) :: integrator
    class(hooke_state), intent(in) :: state
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_estimate_begin(self%address(), integrator%address(), state%address()), status)
  end subroutine

  ! Adds a state of the run, for observers to call.
  subroutine see(self, step, state)
    class(hooke_estimate), intent(in) :: self
    integer(c_int64_t), intent(in) :: step
    class(hooke_state), intent(in) :: state
    integer(c_int32_t) :: nothing
    nothing = c_estimate_see(step, state%address(), self%address())
  end subroutine

  ! Call after the run, whose last state is `state`.
  subroutine measure(self, integrator, state, status)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_integrator), intent(in) :: integrator
    class(hooke_state), intent(in) :: state
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_estimate_measure(self%address(), integrator%address(), state%address()), status)
  end subroutine

  ! Sets something finer in `run`.
  subroutine refine(self, run, status)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_options), intent(inout) :: run
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_estimate_refine(self%address(), run%address()), status)
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_estimate), intent(inout) :: self
    type(hooke_estimate), intent(in) :: other
    call self%share(other)
  end subroutine
end module
