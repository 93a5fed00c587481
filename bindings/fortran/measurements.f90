! Measurements of a scene: one type with options, progress, a run, and tables of results.
module hooke_measurements
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_funloc, c_int32_t, c_int64_t, c_null_ptr, c_ptr
  use hooke_base, only: accept, hooke_bad_call, hooke_bad_value, is_3_by, refuse, to_c, to_c_if, to_integer, to_series, &
    to_text, zero_based
  use hooke_c_measurement
  use hooke_handles, only: callback_to, hooke_callback, hooke_handle
  use hooke_integrators, only: hooke_integrator
  use hooke_observers, only: call_comparison_observer, call_progress, hooke_comparison_observer, hooke_progress
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_queries_of_measurement, only: hooke_measurement_queries
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_measurement, measurement_table, measurement_column, limit_of_mode

  integer, parameter :: of_progress = 1, of_frames = 2

  type, extends(hooke_measurement_queries) :: hooke_measurement
    integer(c_int64_t), private :: particles = 0 ! of its system
  contains
    procedure :: create
    procedure :: create_why      ! of an integrator whose run ended early,
    procedure :: create_why_kept ! of states that were kept of it,
    procedure :: create_verify   ! of a trajectory
    procedure :: on_progress
    procedure :: run
    procedure :: find
    procedure :: series
    procedure :: recommend
    procedure :: on_frame      ! of a comparison
    procedure :: lean          ! of needs: the lean system,
    procedure :: lean_run      ! its run,
    procedure :: lean_particle ! and the map from the full one
    procedure :: lean_position
    procedure :: advice_apply  ! of a why
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
    if (code == 0) self%particles = system%particle_count()
    call accept(code, status)
  end subroutine

  ! For a trajectory; `options` are those of "verify", `limits` those of "limits".
  subroutine create_verify(self, path, options, limits, status)
    class(hooke_measurement), intent(inout) :: self
    character(*), intent(in) :: path
    type(hooke_options), intent(in), optional :: options, limits
    integer, intent(out), optional :: status
    type(c_ptr) :: made
    integer(c_int32_t) :: code
    code = c_verify_create(to_c(path), options_or_null(options), options_or_null(limits), made)
    if (code == 0) call self%take(made, c_measurement_destroy)
    call accept(code, status)
  end subroutine

  ! A "why": for an integrator whose last run ended early; it must not change until run() has returned.
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

  ! The same from states that were kept of a run: the initial one, and the last good one.
  subroutine create_why_kept(self, system, run, first, last, options, status)
    class(hooke_measurement), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in) :: run
    class(hooke_state), intent(in) :: first, last
    type(hooke_options), intent(in), optional :: options
    integer, intent(out), optional :: status
    type(c_ptr) :: made
    integer(c_int32_t) :: code
    if (system%is_missing(status, run)) return
    if (first%is_missing(status, last)) return
    code = c_why_create_kept(system%address(), run%address(), first%address(), last%address(), &
      options_or_null(options), made)
    if (code == 0) call self%take(made, c_measurement_destroy, system)
    call accept(code, status)
  end subroutine

  ! Sets the progress callback, which must exist as long as it is set; without an argument it is removed.
  subroutine on_progress(self, progress)
    class(hooke_measurement), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(hooke_callback) :: callback
    callback = callback_to(c_funloc(call_progress), progress)
    call c_measurement_on_progress(self%address(), callback%function, callback%data)
    call self%keep(callback, of_progress, 0_c_int32_t)
  end subroutine

  ! Measures. A limit and a cost are those at `state`, by default the initial one; other kinds take no state.
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

  ! The library's array; valid until the next run.
  function series(self, table, row, column)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: table, column
    integer, intent(in) :: row
    real(c_double), pointer, contiguous :: series(:)
    integer(c_int64_t) :: count(1)
    type(c_ptr) :: found
    count = 0
    found = c_measurement_series(self%address(), to_c(table), zero_based(row), to_c(column), count)
    series => to_series(found, count(1))
  end function

  ! ---- kinds, tables and columns ----

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

  ! ---- a study ----

  ! Recommends the cheapest run found whose error_max, the largest distance of any free particle, is at most `want` [m].
  subroutine recommend(self, want, status)
    class(hooke_measurement), intent(inout) :: self
    real(c_double), intent(in) :: want
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_study_recommend(self%address(), want), status)
  end subroutine

  ! ---- a comparison ----

  ! Sets the observer of the frames of all runs, which must exist as long as it is set; without an argument it
  ! is removed.
  subroutine on_frame(self, observer, status)
    class(hooke_measurement), intent(inout) :: self
    class(hooke_comparison_observer), target, intent(inout), optional :: observer
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_comparison_observer), observer)
    call self%keep(callback, of_frames, c_comparison_on_frame(self%address(), callback%function, callback%data), status)
  end subroutine

  ! ---- needs ----

  ! The lean system; hooke_bad_call before it was found.
  subroutine lean(self, system, status)
    class(hooke_measurement), intent(in) :: self
    class(hooke_system), intent(inout) :: system
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call lend(self, c_needs_lean(self%address()), system, status)
  end subroutine

  subroutine lean_run(self, options, status)
    class(hooke_measurement), intent(in) :: self
    class(hooke_options), intent(inout) :: options
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call lend(self, c_needs_lean_run(self%address()), options, status)
  end subroutine

  subroutine lend(self, address, object, status)
    class(hooke_measurement), intent(in) :: self
    type(c_ptr), intent(in) :: address
    class(hooke_handle), intent(inout) :: object
    integer, intent(out), optional :: status
    if (c_associated(address)) then
      call object%take(address, owner=self)
      call accept(0_c_int32_t, status)
    else
      call refuse(hooke_bad_call, "there is no lean system: of needs it is found by run()", status)
    end if
  end subroutine

  ! The particle of the lean system that is a particle of the full one; 0 if it was left out.
  integer function lean_particle(self, particle)
    class(hooke_measurement), intent(in) :: self
    integer, intent(in) :: particle
    lean_particle = int(c_needs_lean_particle(self%address(), zero_based(particle))) + 1
  end function

  ! Positions of all particles of the full system at positions q of the lean one, NaN where they were left out.
  subroutine lean_position(self, q, position, status)
    class(hooke_measurement), intent(in) :: self
    real(c_double), intent(in), contiguous :: q(:, :)
    real(c_double), intent(inout), contiguous :: position(:, :)
    integer, intent(out), optional :: status
    type(hooke_system) :: system
    logical :: fits
    call self%lean(system, status)
    if (.not. system%exists()) return
    fits = is_3_by(q, int(system%particle_count(), c_int64_t)) .and. is_3_by(position, self%particles)
    if (.not. fits) then
      call refuse(hooke_bad_value, "an array has not the shape (3, particle_count()) of its system", status)
      return
    end if
    call accept(c_needs_lean_position(self%address(), q, position), status)
  end subroutine

  ! ---- a limit ----

  ! Largest step [s] at which `method` is stable for x'' + 2 decay x' + frequency^2 x = 0.
  real(c_double) function limit_of_mode(method, frequency, decay)
    character(*), intent(in) :: method
    real(c_double), intent(in) :: frequency, decay
    limit_of_mode = c_limit_of_mode(to_c(method), frequency, decay)
  end function

  ! ---- a why ----

  ! Sets every option of a row of the table "advice" in `run`.
  subroutine advice_apply(self, row, run, status)
    class(hooke_measurement), intent(in) :: self
    integer, intent(in) :: row
    type(hooke_options), intent(inout) :: run
    integer, intent(out), optional :: status
    if (self%is_missing(status, run)) return
    call accept(c_why_advice_apply(self%address(), zero_based(row), run%address()), status)
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_measurement), intent(inout) :: self
    type(hooke_measurement), intent(in) :: other
    call self%share(other)
    self%particles = other%particles
  end subroutine
end module
