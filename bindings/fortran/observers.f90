! Observers and rates: types to extend, and their interface to C.
!
! A `stop_value` is initially 0; any other value stops the run and is returned by hooke_integrator's
! stop_value().
module hooke_observers
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int32_t, c_int64_t, c_null_ptr, c_ptr
  use hooke_base, only: hooke_long, to_text
  use hooke_states, only: hooke_state
  implicit none
  private
  public :: hooke_rate, hooke_observer, hooke_progress, hooke_warning, hooke_comparison_observer
  public :: rate_holder, observer_holder, progress_holder, warning_holder, comparison_holder
  public :: call_rate, call_observer, call_progress, call_warning, call_comparison_observer

  ! The right-hand side of x' = phi(t, x).
  type, abstract :: hooke_rate
  contains
    procedure(evaluate_rate), deferred :: evaluate
  end type

  ! Receives the state after `step` steps; must not change it, nor keep it.
  type, abstract :: hooke_observer
  contains
    procedure(see_state), deferred :: see
  end type

  ! Receives progress: the fraction done (0..1) and the name of the running task.
  type, abstract :: hooke_progress
  contains
    procedure(tell_progress), deferred :: tell
  end type

  ! Receives a warning that the step is no longer safe: "near-limit", "above-limit" or "never-stable"; the
  ! bound [s]; and what determines it, 0 for no spring.
  type, abstract :: hooke_warning
  contains
    procedure(warn_of_step), deferred :: warn
  end type

  ! Receives a frame of a run of a comparison, "reference" or a method's name.
  type, abstract :: hooke_comparison_observer
  contains
    procedure(see_frame), deferred :: see
  end type

  abstract interface
    subroutine evaluate_rate(self, n, t, x, rate, stop_value)
      import :: c_double, hooke_rate
      class(hooke_rate), intent(inout) :: self
      integer, intent(in) :: n
      real(c_double), intent(in) :: t, x(n)
      real(c_double), intent(out) :: rate(n)
      integer, intent(inout) :: stop_value
    end subroutine

    subroutine see_state(self, step, state, stop_value)
      import :: hooke_long, hooke_observer, hooke_state
      class(hooke_observer), intent(inout) :: self
      integer(hooke_long), intent(in) :: step
      type(hooke_state), intent(in) :: state
      integer, intent(inout) :: stop_value
    end subroutine

    subroutine tell_progress(self, done, what, stop_value)
      import :: c_double, hooke_progress
      class(hooke_progress), intent(inout) :: self
      real(c_double), intent(in) :: done
      character(*), intent(in) :: what
      integer, intent(inout) :: stop_value
    end subroutine

    subroutine warn_of_step(self, kind, sentence, t, limit, spring, particle, stop_value)
      import :: c_double, hooke_warning
      class(hooke_warning), intent(inout) :: self
      character(*), intent(in) :: kind, sentence
      real(c_double), intent(in) :: t, limit
      integer, intent(in) :: spring, particle
      integer, intent(inout) :: stop_value
    end subroutine

    subroutine see_frame(self, run, frame, step, state, stop_value)
      import :: hooke_comparison_observer, hooke_long, hooke_state
      class(hooke_comparison_observer), intent(inout) :: self
      character(*), intent(in) :: run
      integer, intent(in) :: frame
      integer(hooke_long), intent(in) :: step
      type(hooke_state), intent(in) :: state
      integer, intent(inout) :: stop_value
    end subroutine
  end interface

  type :: rate_holder
    class(hooke_rate), pointer :: rate => null()
  end type

  type :: observer_holder
    class(hooke_observer), pointer :: observer => null()
    type(hooke_state) :: state
  end type

  type :: progress_holder
    class(hooke_progress), pointer :: progress => null()
  end type

  type :: warning_holder
    class(hooke_warning), pointer :: warning => null()
  end type

  type :: comparison_holder
    class(hooke_comparison_observer), pointer :: observer => null()
    type(hooke_state) :: state
  end type

contains

  integer(c_int32_t) function call_rate(n, t, x, rate, ctx) bind(c, name="")
    integer(c_int64_t), value :: n
    real(c_double), value :: t
    real(c_double), intent(in) :: x(n)
    real(c_double), intent(out) :: rate(n)
    type(c_ptr), value :: ctx
    type(rate_holder), pointer :: holder
    integer :: stop_value
    call c_f_pointer(ctx, holder)
    stop_value = 0
    call holder%rate%evaluate(int(n), t, x, rate, stop_value)
    call_rate = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_observer(step, state, ctx) bind(c, name="")
    integer(c_int64_t), value :: step
    type(c_ptr), value :: state, ctx
    type(observer_holder), pointer :: holder
    integer :: stop_value
    call c_f_pointer(ctx, holder)
    stop_value = 0
    call holder%state%look_at(state)
    call holder%observer%see(step, holder%state, stop_value)
    call holder%state%look_at(c_null_ptr)
    call_observer = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_progress(done, what, ctx) bind(c, name="")
    real(c_double), value :: done
    type(c_ptr), value :: what, ctx
    type(progress_holder), pointer :: holder
    integer :: stop_value
    call c_f_pointer(ctx, holder)
    stop_value = 0
    call holder%progress%tell(done, to_text(what), stop_value)
    call_progress = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_warning(kind, sentence, t, limit, spring, particle, ctx) bind(c, name="")
    type(c_ptr), value :: kind, sentence, ctx
    real(c_double), value :: t, limit
    integer(c_int64_t), value :: spring, particle
    type(warning_holder), pointer :: holder
    integer :: stop_value
    call c_f_pointer(ctx, holder)
    stop_value = 0
    call holder%warning%warn(to_text(kind), to_text(sentence), t, limit, int(spring) + 1, int(particle) + 1, stop_value)
    call_warning = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_comparison_observer(run, frame, step, state, ctx) bind(c, name="")
    type(c_ptr), value :: run, state, ctx
    integer(c_int64_t), value :: frame, step
    type(comparison_holder), pointer :: holder
    integer :: stop_value
    call c_f_pointer(ctx, holder)
    stop_value = 0
    call holder%state%look_at(state)
    call holder%observer%see(to_text(run), int(frame) + 1, step, holder%state, stop_value)
    call holder%state%look_at(c_null_ptr)
    call_comparison_observer = int(stop_value, c_int32_t)
  end function
end module
