! Observers and rates: types to extend, and their interface to C.
!
! A `stop_value` is initially 0; any other value stops the run and is returned by hooke_integrator's
! stop_value().
module hooke_observers
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int32_t, c_int64_t, c_null_ptr, c_ptr
  use hooke_base, only: hooke_long, to_text
  use hooke_handles, only: called_object
  use hooke_states, only: hooke_state
  implicit none
  private
  public :: hooke_rate, hooke_observer, hooke_progress, hooke_warning, hooke_comparison_observer
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

contains

  integer(c_int32_t) function call_rate(n, t, x, rate, ctx) bind(c, name="")
    integer(c_int64_t), value :: n
    real(c_double), value :: t
    real(c_double), intent(in) :: x(n)
    real(c_double), intent(out) :: rate(n)
    type(c_ptr), value :: ctx
    type(called_object), pointer :: called
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    select type (it => called%it)
    class is (hooke_rate)
      call it%evaluate(int(n), t, x, rate, stop_value)
    end select
    call_rate = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_observer(step, state, ctx) bind(c, name="")
    integer(c_int64_t), value :: step
    type(c_ptr), value :: state, ctx
    type(called_object), pointer :: called
    type(hooke_state) :: seen
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    call seen%look_at(state)
    select type (it => called%it)
    class is (hooke_observer)
      call it%see(step, seen, stop_value)
    end select
    call seen%look_at(c_null_ptr)
    call_observer = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_progress(done, what, ctx) bind(c, name="")
    real(c_double), value :: done
    type(c_ptr), value :: what, ctx
    type(called_object), pointer :: called
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    select type (it => called%it)
    class is (hooke_progress)
      call it%tell(done, to_text(what), stop_value)
    end select
    call_progress = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_warning(kind, sentence, t, limit, spring, particle, ctx) bind(c, name="")
    type(c_ptr), value :: kind, sentence, ctx
    real(c_double), value :: t, limit
    integer(c_int64_t), value :: spring, particle
    type(called_object), pointer :: called
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    select type (it => called%it)
    class is (hooke_warning)
      call it%warn(to_text(kind), to_text(sentence), t, limit, int(spring) + 1, int(particle) + 1, stop_value)
    end select
    call_warning = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_comparison_observer(run, frame, step, state, ctx) bind(c, name="")
    type(c_ptr), value :: run, state, ctx
    integer(c_int64_t), value :: frame, step
    type(called_object), pointer :: called
    type(hooke_state) :: seen
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    call seen%look_at(state)
    select type (it => called%it)
    class is (hooke_comparison_observer)
      call it%see(to_text(run), int(frame) + 1, step, seen, stop_value)
    end select
    call seen%look_at(c_null_ptr)
    call_comparison_observer = int(stop_value, c_int32_t)
  end function
end module
