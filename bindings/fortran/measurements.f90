! What hooke measures of a scene: studies, limits, needs, costs, comparisons, and why a run ended early.
module hooke_measurements
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_int32_t, c_int64_t, c_loc, c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_c, to_c_if, to_integer, to_number, to_series, to_text, zero_based
  use hooke_c_measurement
  use hooke_handles, only: hooke_handle
  use hooke_integrators, only: hooke_integrator
  use hooke_observers, only: call_progress, hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_measurement, limit_of_mode

  integer, parameter :: of_progress = 1

  type, extends(hooke_handle) :: hooke_measurement
  contains
    procedure :: create
    procedure :: create_why
    procedure :: create_why_kept
    procedure :: kind => kind_of
    procedure :: on_progress
    procedure :: run
    procedure :: table
    procedure :: column
    procedure :: row_count
    procedure :: number
    procedure :: text
    procedure :: series
    procedure :: advice_apply
    procedure :: label
    procedure :: write
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! `kind` is "study", "limit", "needs", "cost" or "comparison"; `run` are options of a run, `options` those of the kind.
  subroutine create(self, kind, system, run, options, status)
    class(hooke_measurement), intent(inout) :: self
    character(*), intent(in) :: kind
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in), optional :: run, options
    integer, intent(out), optional :: status
    type(c_ptr) :: made
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    code = c_measurement_create(to_c(kind), system%address(), options_or_null(run), options_or_null(options), made)
    if (code == 0) call self%take(made, c_measurement_destroy, system)
    call accept(code, status)
  end subroutine

  ! A "why": from an integrator whose last run ended early, and which stays as it is until run() has returned.
  subroutine create_why(self, integrator, options, status)
    class(hooke_measurement), intent(inout) :: self
    class(hooke_integrator), intent(in) :: integrator
    type(hooke_options), intent(in), optional :: options
    integer, intent(out), optional :: status
    type(c_ptr) :: made
    integer(c_int32_t) :: code
    if (integrator%is_missing(status)) return
    code = c_why_create(integrator%address(), options_or_null(options), made)
    if (code == 0) call self%take(made, c_measurement_destroy, integrator)
    call accept(code, status)
  end subroutine

  ! The same from states that were kept of a run: the one it began with, and the last good one.
  subroutine create_why_kept(self, system, run, first, last, options, status)
    class(hooke_measurement), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in) :: run
    class(hooke_state), intent(in) :: first, last
    type(hooke_options), intent(in), optional :: options
    integer, intent(out), optional :: status
    type(c_ptr) :: made
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    if (run%is_missing(status)) return
    if (first%is_missing(status)) return
    if (last%is_missing(status)) return
    code = c_why_create_kept(system%address(), run%address(), first%address(), last%address(), &
      options_or_null(options), made)
    if (code == 0) call self%take(made, c_measurement_destroy, system)
    call accept(code, status)
  end subroutine

  function kind_of(self) result(text)
    class(hooke_measurement), intent(in) :: self
    character(:), allocatable :: text
    text = to_text(c_measurement_kind(self%address()))
  end function

  ! Told of progress; has to stay where it is as long as it is. Without one it is taken back.
  subroutine on_progress(self, progress)
    class(hooke_measurement), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(progress_holder), pointer :: holder
    if (.not. present(progress)) then
      call c_measurement_on_progress(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%progress => progress
    call c_measurement_on_progress(self%address(), c_funloc(call_progress), c_loc(holder))
    call self%keep(holder, of_progress)
  end subroutine

  ! Measures; `state` is what a limit or a cost looks at, the initial state without it.
  subroutine run(self, state, status)
    class(hooke_measurement), intent(inout) :: self
    class(hooke_state), intent(inout), optional :: state
    integer, intent(out), optional :: status
    type(c_ptr) :: at
    if (self%is_missing(status)) return
    at = c_null_ptr
    if (present(state)) then
      if (state%is_missing(status)) return
      at = state%address()
    end if
    call accept(c_measurement_run(self%address(), at), status)
  end subroutine

  ! ---- tables; rows are counted from 1, a record has one ----

  ! Of table `place` of its kind "name", "doc" and "shape" ("record" or "rows"); "" past the last.
  function table(self, place, what) result(text)
    class(hooke_measurement), intent(in) :: self
    integer, intent(in) :: place
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_measurement_table(to_c(self%kind()), zero_based(place), to_c(what)))
  end function

  ! Of column `place` of a table "name", "unit", "doc" and "type"; "" past the last.
  function column(self, table, place, what) result(text)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: table, what
    integer, intent(in) :: place
    character(:), allocatable :: text
    text = to_text(c_measurement_column(to_c(self%kind()), to_c(table), zero_based(place), to_c(what)))
  end function

  integer function row_count(self, table)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: table
    row_count = to_integer(c_measurement_row_count(self%address(), to_c(table)))
  end function

  ! NaN where it does not apply or is not known. Numbers of particles, springs and groups count from 1.
  real(c_double) function number(self, table, row, column)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: table, column
    integer, intent(in) :: row
    number = to_number(c_measurement_number(self%address(), to_c(table), zero_based(row), to_c(column)), column)
  end function

  function text(self, table, row, column)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: table, column
    integer, intent(in) :: row
    character(:), allocatable :: text
    text = to_text(c_measurement_text(self%address(), to_c(table), zero_based(row), to_c(column)))
  end function

  ! Of the library; valid until it is run again.
  function series(self, table, row, column)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: table, column
    integer, intent(in) :: row
    real(c_double), pointer, contiguous :: series(:)
    series => to_series(c_measurement_series(self%address(), to_c(table), zero_based(row), to_c(column)), &
      c_measurement_series_count(self%address(), to_c(table), zero_based(row), to_c(column)))
  end function

  ! ---- what a kind has besides ----

  ! Sets every option of that row of the table "advice" of a "why" in `run`.
  subroutine advice_apply(self, row, run, status)
    class(hooke_measurement), intent(in) :: self
    integer, intent(in) :: row
    type(hooke_options), intent(inout) :: run
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (run%is_missing(status)) return
    call accept(c_why_advice_apply(self%address(), zero_based(row), run%address()), status)
  end subroutine

  ! The step [s] up to which `method` is stable for x'' + 2 decay x' + frequency^2 x = 0.
  real(c_double) function limit_of_mode(method, frequency, decay)
    character(*), intent(in) :: method
    real(c_double), intent(in) :: frequency, decay
    limit_of_mode = c_limit_of_mode(to_c(method), frequency, decay)
  end function

  ! ---- files ----

  ! "title", "command" or "scene": a text that files show. Without `text` it is taken back.
  subroutine label(self, what, text, status)
    class(hooke_measurement), intent(inout) :: self
    character(*), intent(in) :: what
    character(*), intent(in), optional :: text
    integer, intent(out), optional :: status
    character(:), allocatable :: c_text
    if (self%is_missing(status)) return
    call to_c_if(text, c_text)
    call accept(c_measurement_label(self%address(), to_c(what), c_text), status)
  end subroutine

  ! By the ending of `path`: .csv, .json, .h5 or .html.
  subroutine write(self, path, status)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_measurement_write(self%address(), to_c(path)), status)
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_measurement), intent(inout) :: self
    type(hooke_measurement), intent(in) :: other
    call self%share(other)
  end subroutine
end module
