! Why a run ended early, where and when, and what to do.
module hooke_causes
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_c, to_integer, to_number, to_text, zero_based
  use hooke_c_why
  use hooke_handles, only: hooke_handle
  use hooke_integrators, only: hooke_integrator
  use hooke_option_tables, only: hooke_options
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_why

  type, extends(hooke_handle) :: hooke_why
  contains
    procedure :: create
    procedure :: create_kept
    procedure :: text
    procedure :: number
    procedure :: blame_count
    procedure :: blame_number
    procedure :: blame_text
    procedure :: advice_count
    procedure :: advice_text
    procedure :: advice_apply
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! From an integrator whose last run ended early, within `seconds` (as long as the run took, or 2 s if that is more).
  subroutine create(self, integrator, seconds, status)
    class(hooke_why), intent(inout) :: self
    class(hooke_integrator), intent(in) :: integrator
    real(c_double), intent(in), optional :: seconds
    integer, intent(out), optional :: status
    type(c_ptr) :: why
    integer(c_int32_t) :: code
    if (integrator%is_missing(status)) return
    code = c_why_create(integrator%address(), within(seconds), c_null_funptr, c_null_ptr, why)
    if (code == 0) call self%take(why, c_why_destroy, integrator)
    call accept(code, status)
  end subroutine

  ! From states that were kept of a run: the one it began with, and the last good one.
  subroutine create_kept(self, system, run, first, last, seconds, status)
    class(hooke_why), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in) :: run
    class(hooke_state), intent(in) :: first, last
    real(c_double), intent(in), optional :: seconds
    integer, intent(out), optional :: status
    type(c_ptr) :: why
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    if (run%is_missing(status)) return
    if (first%is_missing(status)) return
    if (last%is_missing(status)) return
    code = c_why_create_kept(system%address(), run%address(), first%address(), last%address(), within(seconds), &
      c_null_funptr, c_null_ptr, why)
    if (code == 0) call self%take(why, c_why_destroy, system)
    call accept(code, status)
  end subroutine

  ! The time that an explanation may take; 0, the usual one, where it is not given.
  real(c_double) function within(seconds)
    real(c_double), intent(in), optional :: seconds
    within = 0
    if (present(seconds)) within = seconds
  end function

  ! "cause", "sentence", "method", "left_out".
  function text(self, what)
    class(hooke_why), intent(in) :: self
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_why_text(self%address(), to_c(what)))
  end function

  ! "time", "noticed", "step", "limit" [s], "particle"; NaN where it does not apply.
  real(c_double) function number(self, what)
    class(hooke_why), intent(in) :: self
    character(*), intent(in) :: what
    number = to_number(c_why_number(self%address(), to_c(what)), what)
  end function

  ! ---- springs to blame: "spring", "first", "second", "share", "group" ----

  integer function blame_count(self)
    class(hooke_why), intent(in) :: self
    blame_count = to_integer(c_why_blame_count(self%address()))
  end function

  real(c_double) function blame_number(self, place, what)
    class(hooke_why), intent(in) :: self
    integer, intent(in) :: place
    character(*), intent(in) :: what
    blame_number = to_number(c_why_blame_number(self%address(), zero_based(place), to_c(what)), what)
  end function

  function blame_text(self, place, what) result(text)
    class(hooke_why), intent(in) :: self
    integer, intent(in) :: place
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_why_blame_text(self%address(), zero_based(place), to_c(what)))
  end function

  ! ---- what to do, the best first: "change", "option", "value" ----

  integer function advice_count(self)
    class(hooke_why), intent(in) :: self
    advice_count = to_integer(c_why_advice_count(self%address()))
  end function

  function advice_text(self, place, what) result(text)
    class(hooke_why), intent(in) :: self
    integer, intent(in) :: place
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_why_advice_text(self%address(), zero_based(place), to_c(what)))
  end function

  ! Sets every option of this advice in `run`.
  subroutine advice_apply(self, place, run, status)
    class(hooke_why), intent(in) :: self
    integer, intent(in) :: place
    type(hooke_options), intent(inout) :: run
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (run%is_missing(status)) return
    call accept(c_why_advice_apply(self%address(), zero_based(place), run%address()), status)
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_why), intent(inout) :: self
    type(hooke_why), intent(in) :: other
    call self%share(other)
  end subroutine
end module
