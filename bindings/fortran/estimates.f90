! The error of a run, and a method and a step or tolerance for a wanted error.
module hooke_estimates
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_null_ptr, c_ptr
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use hooke_base, only: accept, to_c
  use hooke_c_estimate
  use hooke_queries_of_estimate
  use hooke_c_measurement, only: c_measurement_create, c_measurement_destroy, c_measurement_run
  use hooke_handles, only: missing
  use hooke_integrators, only: hooke_integrator
  use hooke_option_tables, only: hooke_options
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_estimate

  type, extends(hooke_estimate_queries) :: hooke_estimate
  contains
    procedure :: create
    procedure :: see
    procedure :: measure
  end type

contains

  ! `want` [m] is the error that no particle may exceed at any frame; NaN for none. `callbacks`: whether runs are
  ! repeated even if callbacks take part; they are not if it is left out.
  subroutine create(self, system, want, status, callbacks)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    real(c_double), intent(in) :: want
    integer, intent(out), optional :: status
    logical, intent(in), optional :: callbacks
    type(hooke_options) :: options
    type(c_ptr) :: estimate
    integer(c_int32_t) :: code
    if (missing(status, system)) return
    call options%create("estimate", status)
    if (.not. options%exists()) return
    if (.not. ieee_is_nan(want)) then
      call options%set("want", want, status)
      if (.not. options%is_set("want")) return
    end if
    if (present(callbacks)) call options%set("callbacks", merge(1.0_c_double, 0.0_c_double, callbacks), status)
    code = c_measurement_create(to_c("estimate"), system%address(), c_null_ptr, options%address(), estimate)
    if (code == 0) call self%take(estimate, c_measurement_destroy, system)
    call accept(code, status)
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
    if (missing(status, self, integrator, state)) return
    call accept(c_measurement_run(self%address(), state%address()), status)
  end subroutine

end module
