! How accurate each method is for what it costs, and which one to take.
module hooke_studies
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_int32_t, c_loc, c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_c, to_c_if, to_integer, to_series, to_text, zero_based
  use hooke_c_io, only: c_study_write_csv, c_study_write_h5, c_study_write_report
  use hooke_c_study
  use hooke_handles, only: hooke_handle
  use hooke_observers, only: call_progress, hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_study, study_pick

  integer, parameter :: of_progress = 1

  type, extends(hooke_handle) :: hooke_study
  contains
    procedure :: create
    procedure :: on_progress
    procedure :: run
    procedure :: reference
    procedure :: figure
    procedure :: row_count
    procedure :: text
    procedure :: number
    procedure :: frame_count
    procedure :: series
    procedure :: order
    procedure :: order_note
    procedure :: statistic
    procedure :: recommend
    procedure :: recommendation_text
    procedure :: recommendation_number
    procedure :: write_csv
    procedure :: write_h5
    procedure :: write_report
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! `run` (of a run) gives the duration; `options` are those of a study.
  subroutine create(self, system, run, options, status)
    class(hooke_study), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in), optional :: run, options
    integer, intent(out), optional :: status
    type(c_ptr) :: study
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    code = c_study_create(system%address(), options_or_null(run), options_or_null(options), study)
    if (code == 0) call self%take(study, c_study_destroy, system)
    call accept(code, status)
  end subroutine

  ! Told of progress; has to stay where it is as long as it is. Without one it is taken back.
  subroutine on_progress(self, progress)
    class(hooke_study), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(progress_holder), pointer :: holder
    if (.not. present(progress)) then
      call c_study_on_progress(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%progress => progress
    call c_study_on_progress(self%address(), c_funloc(call_progress), c_loc(holder))
    call self%keep(holder, of_progress)
  end subroutine

  ! Makes the reference, runs the ladders, fits the orders and, if `want` is set, recommends.
  subroutine run(self, status)
    class(hooke_study), intent(inout) :: self
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_study_run(self%address()), status)
  end subroutine

  ! "method" and "check": the two integrators that made the reference.
  function reference(self, what) result(text)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_study_reference(self%address(), to_c(what)))
  end function

  ! "agreement" [m], "trusted_until" [s] and more; NaN for another word.
  real(c_double) function figure(self, what)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: what
    figure = c_study_figure(self%address(), to_c(what))
  end function

  ! ---- rows: a method with one step or tolerance each ----

  integer function row_count(self)
    class(hooke_study), intent(in) :: self
    row_count = to_integer(c_study_row_count(self%address()))
  end function

  function text(self, row, what)
    class(hooke_study), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_study_text(self%address(), zero_based(row), to_c(what)))
  end function

  real(c_double) function number(self, row, what)
    class(hooke_study), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    number = c_study_number(self%address(), zero_based(row), to_c(what))
  end function

  integer function frame_count(self)
    class(hooke_study), intent(in) :: self
    frame_count = to_integer(c_study_frame_count(self%address()))
  end function

  function series(self, row, what)
    class(hooke_study), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    real(c_double), pointer, contiguous :: series(:)
    series => to_series(c_study_series(self%address(), zero_based(row), to_c(what)), &
      c_study_frame_count(self%address()))
  end function

  ! "order", its 95 % interval "low" and "high", and "theory".
  real(c_double) function order(self, method, what)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: method, what
    order = c_study_order(self%address(), to_c(method), to_c(what))
  end function

  function order_note(self, method) result(text)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: method
    character(:), allocatable :: text
    text = to_text(c_study_order_note(self%address(), to_c(method)))
  end function

  ! "mean", "spread", "members", "failed", "step", "rtol" or "bias" of a quantity, by a method or the "reference".
  real(c_double) function statistic(self, method, quantity, what)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: method, quantity, what
    statistic = c_study_statistic(self%address(), to_c(method), to_c(quantity), to_c(what))
  end function

  ! Finds the cheapest step or tolerance whose error is at most `want` [m].
  subroutine recommend(self, want, status)
    class(hooke_study), intent(inout) :: self
    real(c_double), intent(in) :: want
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_study_recommend(self%address(), want), status)
  end subroutine

  function recommendation_text(self, what) result(text)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_study_recommendation_text(self%address(), to_c(what)))
  end function

  real(c_double) function recommendation_number(self, what)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: what
    recommendation_number = c_study_recommendation_number(self%address(), to_c(what))
  end function

  ! ---- all that it has so far, as a file ----

  subroutine write_csv(self, path, status)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_study_write_csv(self%address(), to_c(path)), status)
  end subroutine

  ! `outcome` is the status of run().
  subroutine write_h5(self, path, scene_text, outcome, status)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: path
    character(*), intent(in), optional :: scene_text
    integer, intent(in), optional :: outcome
    integer, intent(out), optional :: status
    character(:), allocatable :: c_text
    integer(c_int32_t) :: ended
    if (self%is_missing(status)) return
    ended = 0
    if (present(outcome)) ended = int(outcome, c_int32_t)
    call to_c_if(scene_text, c_text)
    call accept(c_study_write_h5(self%address(), to_c(path), c_text, ended), status)
  end subroutine

  ! One HTML page; `scene` is the name over it, `command` the line to type for what is recommended.
  subroutine write_report(self, path, scene, command, status)
    class(hooke_study), intent(in) :: self
    character(*), intent(in) :: path, scene
    character(*), intent(in), optional :: command
    integer, intent(out), optional :: status
    character(:), allocatable :: c_command
    if (self%is_missing(status)) return
    call to_c_if(command, c_command)
    call accept(c_study_write_report(self%address(), to_c(path), to_c(scene), c_command), status)
  end subroutine

  ! Picks a method and its step or tolerance for the error `want` [m], and sets them in `run`.
  subroutine study_pick(system, run, want, progress, status)
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(inout) :: run
    real(c_double), intent(in) :: want
    class(hooke_progress), target, intent(inout), optional :: progress
    integer, intent(out), optional :: status
    type(progress_holder), target :: holder
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    if (run%is_missing(status)) return
    if (present(progress)) then
      holder%progress => progress
      code = c_study_pick(system%address(), run%address(), want, c_funloc(call_progress), c_loc(holder))
    else
      code = c_study_pick(system%address(), run%address(), want, c_null_funptr, c_null_ptr)
    end if
    call accept(code, status)
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_study), intent(inout) :: self
    type(hooke_study), intent(in) :: other
    call self%share(other)
  end subroutine
end module
