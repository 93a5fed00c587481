! hooke for Fortran: mass-spring systems. `use hooke` gives everything below; docs/fortran.md is the
! introduction.
!
! Numbers of particles, springs, triples, groups, rows, places and frames count from 1, in arguments and in
! results. Texts count from 0, as scene files do: messages, sentences, and values of options such as `pinned`
! and `watch`. Arrays of positions, velocities and forces are (3, n); units are SI.
!
! Procedures that can fail have an optional last argument `status`: 0 is success, a negative value a failure,
! a positive value an outcome of a run; hooke_message() then describes it. Without the argument a non-zero
! status ends the program with the message.
!
! Variables of these types are released when they go out of scope, in any order. Assignment makes a second
! reference to the same object; copy_to(), where it exists, copies. Pointers are to the library's memory.
!
! A `stop_value` of a callback is initially 0; any other value stops the run and is returned by hooke_integrator's
! stop_value().
!
! Most procedures are made from the headers of C: hooke_state%time() is hooke_state_time() there.
module hooke
  use, intrinsic :: iso_c_binding
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use hooke_base, hooke_message => last_error, hooke_status_name => status_name
  use hooke_handles
  implicit none
  private
  public :: hooke_real, hooke_long, hooke_message, hooke_status_name, hooke_system_warnings, hooke_step_fit

  ! Named options, with their types, units, bounds and defaults.
  type, extends(hooke_handle) :: hooke_options
    generic :: set => set_numbers, set_wholes, set_logical, set_text
  end type

  ! The system: particles, springs and forces. It is built, committed, and then only queried.
  type, extends(hooke_handle) :: hooke_system
  end type

  ! State of a motion. q(3, n) [m] and v(3, n) [m/s], for reading and, except in an observer, for writing. x and dx are
  ! q and v as lists; a first-order problem has x alone; of a second-order problem take x and dx. The pointers are valid
  ! as long as the state exists.
  type, extends(hooke_handle) :: hooke_state
    real(c_double), pointer, contiguous :: q(:, :) => null(), v(:, :) => null(), x(:) => null(), dx(:) => null()
  end type

  ! A method, and the loop that runs it.
  type, extends(hooke_handle) :: hooke_integrator
    type(hooke_options) :: options ! its own copy, with defaults filled in
    generic :: step => step_int32, step_int64
    generic :: advance => advance_int32, advance_int64
  end type

  ! Measurements of a scene: one type with options, progress, a run, and tables of results, whose rows are counted from 1.
  type, extends(hooke_handle) :: hooke_measurement
  end type

  ! The error of a run, and a method and a step or tolerance for a wanted error.
  type, extends(hooke_handle) :: hooke_estimate
  end type

  ! A scene file (JSON): a system and the options of a run.
  type, extends(hooke_handle) :: hooke_scene
    type(hooke_system) :: system ! built, not yet committed
    type(hooke_options) :: run   ! those of `run`, which may be changed
  end type

  ! A trajectory file (HDF5) being written. One that goes out of scope is closed as "stopped".
  type, extends(hooke_handle) :: hooke_trajectory
  end type

  ! Watched quantities over the runs of an integrator, in a file (CSV or HDF5) being written.
  type, extends(hooke_handle) :: hooke_probes
  end type

  ! A trajectory file being read.
  type, extends(hooke_handle) :: hooke_record
    type(hooke_options) :: options ! of the run, with defaults filled in
  end type

  ! A trajectory as one HTML page that plays it.
  type, extends(hooke_handle) :: hooke_view
  end type

contains

  subroutine options_set_wholes(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value(..)
    integer, intent(out), optional :: status
    integer(c_int64_t), allocatable :: list(:)
    call to_list(value, list) ! of indices, which count from 0
    call self%set(name, real(list + 1, c_double), status)
  end subroutine

  subroutine options_set_logical(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    logical, intent(in) :: value
    integer, intent(out), optional :: status
    call self%set(name, merge(1, 0, value), status)
  end subroutine

  ! All of them.
  function options_numbers(self, name) result(values)
    class(hooke_options), intent(in) :: self
    character(*), intent(in) :: name
    real(c_double), allocatable :: values(:)
    real(c_double), pointer, contiguous :: there(:)
    there => to_series(c_options_numbers(self%address(), to_c(name)), int(self%number_count(name), c_int64_t))
    allocate (values(0))
    if (associated(there)) values = there
  end function

  ! The particles of rigid body number `body`.
  function system_body_particles(self, body) result(particles)
    class(hooke_system), intent(in) :: self
    integer, intent(in) :: body
    integer, allocatable :: particles(:)
    integer(c_int64_t), allocatable :: numbers(:)
    integer(c_int64_t) :: count
    allocate (numbers(c_system_body_particles(self%address(), zero_based(body))), source=0_c_int64_t)
    count = c_system_body_particles(self%address(), zero_based(body), numbers)
    particles = int(numbers) + 1
  end function

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

  ! Makes step, every and duration of a run fit one another; each change is told.
  subroutine hooke_step_fit(system, q, run, told, status)
    class(hooke_system), intent(in) :: system
    real(c_double), intent(in), contiguous, target :: q(:, :)
    class(hooke_options), intent(inout) :: run
    class(hooke_warning), target, intent(inout) :: told
    integer, intent(out), optional :: status
    type(called_object), target :: called
    if (missing(status, system, run)) return
    called%it => told
    call accept(c_step_fit(system%address(), q, run%address(), c_funloc(call_warning), c_loc(called)), status)
  end subroutine

  subroutine state_refresh(self)
    class(hooke_state), intent(inout) :: self
    integer(c_int64_t) :: size
    self%q => null()
    self%v => null()
    self%x => null()
    self%dx => null()
    if (.not. self%exists()) return
    size = self%size()
    self%x => to_series(c_state_position(self%address()), size)
    self%dx => to_series(c_state_velocity(self%address()), size)
    if (.not. associated(self%dx)) return
    self%q(1:3, 1:size/3) => self%x
    self%v(1:3, 1:size/3) => self%dx
  end subroutine

  ! The library's array; valid until the next run.
  function measurement_series(self, table, row, column) result(series)
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

  ! What the results say: the texts of the table "claims", a line each, the most important first.
  function measurement_describe(self) result(lines)
    class(hooke_measurement), intent(in) :: self
    character(:), allocatable :: lines
    integer :: row
    lines = ""
    do row = 1, int(self%row_count("claims"))
      lines = lines // self%text("claims", row, "text") // new_line(lines)
    end do
  end function

  ! Positions of all particles of the full system at positions q of the lean one, NaN where they were left out.
  subroutine measurement_lean_position(self, q, position, status)
    class(hooke_measurement), intent(in) :: self
    real(c_double), intent(in), contiguous :: q(:, :)
    real(c_double), intent(inout), contiguous :: position(:, :)
    integer, intent(out), optional :: status
    type(hooke_system) :: system
    call self%lean(system, status)
    if (.not. system%exists()) return
    if (.not. is_3_by(q, int(system%particle_count(), c_int64_t), status)) return
    if (.not. is_3_by(position, int(self%number("full", 1, "particles"), c_int64_t), status)) return
    call accept(c_needs_lean_position(self%address(), q, position), status)
  end subroutine

  ! `want` [m] is the error that no particle may exceed at any frame; NaN for none. `callbacks`: whether runs are
  ! repeated even if callbacks take part; they are not if it is left out. `watch`: quantities to watch.
  subroutine estimate_create(self, system, want, status, callbacks, watch)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    real(c_double), intent(in) :: want
    integer, intent(out), optional :: status
    logical, intent(in), optional :: callbacks
    character(*), intent(in), optional :: watch
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
    if (present(callbacks)) call options%set("callbacks", callbacks, status)
    if (present(watch)) call options%set("watch", watch, status)
    code = c_measurement_create(to_c("estimate"), system%address(), c_null_ptr, options%address(), estimate)
    if (code == 0) call self%take(estimate, c_measurement_destroy, system)
    call accept(code, status)
  end subroutine

  ! Adds a state of the run, for observers to call.
  subroutine estimate_see(self, step, state)
    class(hooke_estimate), intent(in) :: self
    integer(c_int64_t), intent(in) :: step
    class(hooke_state), intent(in) :: state
    integer(c_int32_t) :: nothing
    nothing = c_estimate_see(step, state%address(), self%address())
  end subroutine

  ! Call after the run, whose last state is `state`.
  subroutine estimate_measure(self, integrator, state, status)
    class(hooke_estimate), intent(inout) :: self
    class(hooke_integrator), intent(in) :: integrator
    class(hooke_state), intent(in) :: state
    integer, intent(out), optional :: status
    if (missing(status, self, integrator, state)) return
    call accept(c_measurement_run(self%address(), state%address()), status)
  end subroutine

  ! Opens the file of a run that was stopped or killed, and sets a new integrator and its state to where it
  ! continues, for resume(). `finished`: there is nothing to continue, and the trajectory stays empty.
  subroutine trajectory_resume(self, path, system, integrator, state, finished, status)
    class(hooke_trajectory), intent(inout) :: self
    character(*), intent(in) :: path
    class(hooke_system), intent(in) :: system
    class(hooke_integrator), intent(inout) :: integrator
    class(hooke_state), intent(inout) :: state
    logical, intent(out), optional :: finished
    integer, intent(out), optional :: status
    type(c_ptr) :: trajectory
    integer(c_int32_t) :: code
    if (missing(status, system, integrator, state)) return
    code = c_trajectory_resume(to_c(path), system%address(), integrator%address(), state%address(), trajectory)
    if (present(finished)) finished = code == 0 .and. .not. c_associated(trajectory)
    if (code == 0 .and. c_associated(trajectory)) call self%take(trajectory, abandon_trajectory, system)
    call accept(code, status)
  end subroutine

  ! Writes the outcome, the status of hooke_integrator's run(), and closes the file.
  subroutine trajectory_close(self, outcome, status)
    class(hooke_trajectory), intent(inout) :: self
    integer, intent(in), optional :: outcome
    integer, intent(out), optional :: status
    integer(c_int32_t) :: ended
    if (missing(status, self)) return
    ended = hooke_ok
    if (present(outcome)) ended = int(outcome, c_int32_t)
    call accept(c_trajectory_close(self%give_up(), ended), status)
  end subroutine

  subroutine abandon_trajectory(object) bind(c, name="")
    type(c_ptr), value :: object
    integer(c_int32_t) :: code
    code = c_trajectory_close(object, int(hooke_stopped, c_int32_t))
    if (code /= 0) return ! no status can be returned
  end subroutine

  ! Closes the file.
  subroutine probes_close(self, status)
    class(hooke_probes), intent(inout) :: self
    integer, intent(out), optional :: status
    if (missing(status, self)) return
    call accept(c_probes_close(self%give_up()), status)
  end subroutine

  subroutine abandon_probes(object) bind(c, name="")
    type(c_ptr), value :: object
    integer(c_int32_t) :: code
    code = c_probes_close(object)
    if (code /= 0) return ! no status can be returned
  end subroutine

  ! A whole array of the file: "time", "step", "kinetic_energy" and so on, a column a frame; "springs", a column a spring,
  ! whose ends count from 1; "mass" and "species", a column a particle.
  subroutine record_numbers(self, what, values, status)
    class(hooke_record), intent(in) :: self
    character(*), intent(in) :: what
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer, intent(out), optional :: status
    integer(c_int64_t) :: rows(1), columns(1)
    integer(c_int32_t) :: code
    if (missing(status, self)) return
    rows = 0
    columns = 0
    code = c_record_size(self%address(), to_c(what), rows, columns)
    allocate (values(columns(1), rows(1)))
    if (code == 0) code = c_record_numbers(self%address(), to_c(what), values)
    if (code == 0 .and. what == "springs") values = values + 1
    call accept(code, status)
  end subroutine

  ! Writes the page; without a `title` its heading is that of the scene.
  subroutine view_write(self, path, title, status)
    class(hooke_view), intent(inout) :: self
    character(*), intent(in) :: path
    character(*), intent(in), optional :: title
    integer, intent(out), optional :: status
    character(:), allocatable :: c_title
    integer(c_int32_t) :: code
    if (missing(status, self)) return
    if (present(title)) c_title = to_c(title)
    code = c_measurement_label(self%address(), to_c("title"), c_title)
    if (code == 0) code = c_measurement_write(self%address(), to_c(path))
    call accept(code, status)
  end subroutine

end module
