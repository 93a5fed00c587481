! Measurements of a scene: one type with options, progress, a run, and tables of results. Studies are of it.
module hooke_measurements
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_int32_t, c_int64_t, c_loc, c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_c, to_c_if, to_integer, to_series, to_text, zero_based
  use hooke_c_measurement
  use hooke_observers, only: call_progress, hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_queries_of_measurement, only: hooke_measurement_queries
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_measurement, measurement_table, measurement_column

  integer, parameter :: of_progress = 1

  type, extends(hooke_measurement_queries) :: hooke_measurement
  contains
    procedure :: create
    procedure :: on_progress
    procedure :: run
    procedure :: find
    procedure :: series
    procedure :: recommend
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! `kind` is "study"; `run` are options of a run, `options` those of the kind.
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

  ! Measures. A study begins at the initial state and takes no `state`.
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

  ! The first row whose `column` is `text`; 0 if there is none.
  integer function find(self, table, column, text)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: table, column, text
    find = to_integer(c_measurement_find(self%address(), to_c(table), to_c(column), to_c(text))) + 1
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

  ! Of a study: finds the cheapest run whose error is at most `want` [m].
  subroutine recommend(self, want, status)
    class(hooke_measurement), intent(inout) :: self
    real(c_double), intent(in) :: want
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_study_recommend(self%address(), want), status)
  end subroutine

  ! ---- what there is ----

  ! "name", "doc" or "shape" ("record" or "rows") of table `table` of a kind, "" past the last; without a kind the "name" of
  ! kind number `table`.
  function measurement_table(kind, table, what) result(text)
    character(*), intent(in), optional :: kind
    integer, intent(in) :: table
    character(*), intent(in) :: what
    character(:), allocatable :: text, c_kind
    call to_c_if(kind, c_kind)
    text = to_text(c_measurement_table(c_kind, zero_based(table), to_c(what)))
  end function

  ! "name", "unit", "type" or "doc" of column `column` of a table, "" past the last.
  function measurement_column(kind, table, column, what) result(text)
    character(*), intent(in) :: kind, table, what
    integer, intent(in) :: column
    character(:), allocatable :: text
    text = to_text(c_measurement_column(to_c(kind), to_c(table), zero_based(column), to_c(what)))
  end function

  impure elemental subroutine assign(self, other)
    class(hooke_measurement), intent(inout) :: self
    type(hooke_measurement), intent(in) :: other
    call self%share(other)
  end subroutine
end module
