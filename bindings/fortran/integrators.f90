! Methods, and the loop that runs them.
module hooke_integrators
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_funptr, c_int32_t, c_int64_t, c_loc, c_null_funptr, &
    c_ptr
  use hooke_base, only: accept, hooke_bad_value, hooke_long, refuse, to_c, to_c_if, to_integer, to_text, zero_based
  use hooke_c_checkpoint, only: c_checkpoint_read, c_checkpoint_write
  use hooke_c_integrator
  use hooke_coordinates
  use hooke_handles, only: called_object, callback_to, hooke_callback
  use hooke_queries_of_integrator
  use hooke_observers
  use hooke_option_tables, only: hooke_options
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_integrator
  public :: hooke_system_warnings, method_count, method_name, method_meant, method_summary, method_is_adaptive, method_is_built
  public :: method_is_suited

  integer, parameter :: of_rate = 1, of_frames = 2, of_steps = 3, of_warnings = 4, of_checkpoints = 5, &
    of_progress = 6, of_coordinates = 7

  type, extends(hooke_integrator_queries) :: hooke_integrator
    ! Its own copy of its options, with defaults filled in.
    type(hooke_options) :: options
  contains
    procedure :: create
    procedure :: create_first_order
    procedure :: create_second_order
    procedure :: on_frame
    procedure :: on_step
    procedure :: on_checkpoint
    procedure :: on_progress
    procedure :: on_warning
    procedure :: write_checkpoint
    procedure :: read_checkpoint
    procedure, private :: step_some, step_many
    generic :: step => step_some, step_many
    procedure, private :: advance_some, advance_many
    generic :: advance => advance_some, advance_many
    procedure :: get
    procedure :: put
    procedure :: destroy
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! ---- methods ----

  integer function method_count()
    method_count = int(c_method_count())
  end function

  function method_name(number) result(text)
    integer, intent(in) :: number
    character(:), allocatable :: text
    text = to_text(c_method_name(zero_based(number)))
  end function

  ! The method that a word means: itself, or that of another common name; several to choose from ("euler"); "" if none.
  function method_meant(word) result(text)
    character(*), intent(in) :: word
    character(:), allocatable :: text
    text = to_text(c_method_meant(to_c(word)))
  end function

  ! One-line description of a method; "" if there is no such name.
  function method_summary(name) result(text)
    character(*), intent(in) :: name
    character(:), allocatable :: text
    text = to_text(c_method_summary(to_c(name)))
  end function

  ! Whether it chooses its steps from tolerances.
  logical function method_is_adaptive(name)
    character(*), intent(in) :: name
    method_is_adaptive = c_method_is_adaptive(to_c(name)) == 1
  end function

  logical function method_is_built(name)
    character(*), intent(in) :: name
    method_is_built = c_method_is_built(to_c(name)) == 1
  end function

  ! Whether it takes a kind of problem: "second-order", with "bodies", "overdamped", or "first-order".
  logical function method_is_suited(name, problem)
    character(*), intent(in) :: name, problem
    method_is_suited = c_method_is_suited(to_c(name), to_c(problem)) == 1
  end function

  ! ---- making ----

  subroutine create(self, system, options, status)
    class(hooke_integrator), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in) :: options
    integer, intent(out), optional :: status
    type(c_ptr) :: integrator
    integer(c_int32_t) :: code
    if (system%is_missing(status, options)) return
    code = c_integrator_create(system%address(), options%address(), integrator)
    if (code == 0) call take_new(self, integrator, system)
    call accept(code, status)
  end subroutine

  ! For x' = phi(t, x) of `size` numbers; the rate must exist as long as the integrator is used.
  subroutine create_first_order(self, size, rate, options, status)
    class(hooke_integrator), intent(inout) :: self
    integer, intent(in) :: size
    class(hooke_rate), target, intent(inout) :: rate
    type(hooke_options), intent(in) :: options
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    type(c_ptr) :: integrator
    integer(c_int32_t) :: code
    if (options%is_missing(status)) return
    callback = callback_to(c_funloc(call_rate), rate)
    code = c_integrator_create_first_order(int(size, c_int64_t), callback%function, callback%data, options%address(), &
      integrator)
    if (code == 0) call take_new(self, integrator)
    call self%keep(callback, of_rate, code, status)
  end subroutine

  ! For q'' = W f(t, q, v) of `size` coordinates, with one inverse mass or one for each; the force must exist
  ! as long as the integrator is used.
  subroutine create_second_order(self, size, force, inverse_mass, options, status)
    class(hooke_integrator), intent(inout) :: self
    integer, intent(in) :: size
    class(hooke_coordinate_force), target, intent(inout) :: force
    real(c_double), intent(in), contiguous :: inverse_mass(:)
    type(hooke_options), intent(in) :: options
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    type(c_funptr) :: product
    type(c_ptr) :: integrator
    integer(c_int32_t) :: code
    if (options%is_missing(status)) return
    callback = callback_to(c_funloc(call_coordinate_force), force)
    product = c_null_funptr
    select type (force)
    class is (hooke_coordinate_force_with_product)
      product = c_funloc(call_coordinate_product)
    end select
    code = c_integrator_create_second_order(int(size, c_int64_t), callback%function, product, callback%data, &
      ubound(inverse_mass, 1, c_int64_t), inverse_mass, options%address(), integrator)
    if (code == 0) call take_new(self, integrator)
    call self%keep(callback, of_coordinates, code, status)
  end subroutine

  subroutine take_new(self, integrator, system)
    class(hooke_integrator), intent(inout) :: self
    type(c_ptr), intent(in) :: integrator
    class(hooke_system), intent(in), optional :: system
    call self%take(integrator, c_integrator_destroy, system)
    call self%options%take(c_integrator_options(integrator), owner=self)
  end subroutine

  ! ---- watching: at most one observer of each kind; without an argument it is removed. Observers must exist
  ! as long as they are set. ----

  subroutine on_frame(self, observer, status)
    class(hooke_integrator), intent(inout) :: self
    class(hooke_observer), target, intent(inout), optional :: observer
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_observer), observer)
    call self%keep(callback, of_frames, c_integrator_on_frame(self%address(), callback%function, callback%data), status)
  end subroutine

  ! Called every `stride` steps.
  subroutine on_step(self, stride, observer, status)
    class(hooke_integrator), intent(inout) :: self
    integer, intent(in) :: stride
    class(hooke_observer), target, intent(inout), optional :: observer
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_observer), observer)
    call self%keep(callback, of_steps, &
      c_integrator_on_step(self%address(), int(stride, c_int64_t), callback%function, callback%data), status)
  end subroutine

  ! Called between two steps, after every `seconds` of work [s].
  subroutine on_progress(self, seconds, progress, status)
    class(hooke_integrator), intent(inout) :: self
    real(c_double), intent(in) :: seconds
    class(hooke_progress), target, intent(inout), optional :: progress
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_progress), progress)
    call self%keep(callback, of_progress, &
      c_integrator_on_progress(self%address(), seconds, callback%function, callback%data), status)
  end subroutine

  ! Called at each checkpoint of the option `checkpoint`.
  subroutine on_checkpoint(self, observer, status)
    class(hooke_integrator), intent(inout) :: self
    class(hooke_observer), target, intent(inout), optional :: observer
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_observer), observer)
    call self%keep(callback, of_checkpoints, &
      c_integrator_on_checkpoint(self%address(), callback%function, callback%data), status)
  end subroutine

  ! Called once a run when the step comes near the safe one, and when it exceeds it.
  subroutine on_warning(self, warning, status)
    class(hooke_integrator), intent(inout) :: self
    class(hooke_warning), target, intent(inout), optional :: warning
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_warning), warning)
    call self%keep(callback, of_warnings, &
      c_integrator_on_warning(self%address(), callback%function, callback%data), status)
  end subroutine

  ! Warns of what a scene may be, but is seldom meant to be.
  subroutine hooke_system_warnings(system, warning, status)
    class(hooke_system), intent(in) :: system
    class(hooke_warning), target, intent(inout) :: warning
    integer, intent(out), optional :: status
    type(called_object), target :: called
    if (system%is_missing(status)) return
    called%it => warning
    call accept(c_system_warnings(system%address(), c_funloc(call_warning), c_loc(called)), status)
  end subroutine

  ! ---- running ----

  ! Writes a checkpoint of the run; `name` identifies the run.
  subroutine write_checkpoint(self, path, state, name, status)
    class(hooke_integrator), intent(in) :: self
    character(*), intent(in) :: path
    class(hooke_state), intent(in) :: state
    character(*), intent(in), optional :: name
    integer, intent(out), optional :: status
    character(:), allocatable :: c_name
    if (self%is_missing(status, state)) return
    call to_c_if(name, c_name)
    call accept(c_checkpoint_write(to_c(path), self%address(), state%address(), c_name), status)
  end subroutine

  ! Sets integrator and state to the point that the file holds, for resume() or step(); of any run if `name`
  ! is absent.
  subroutine read_checkpoint(self, path, state, name, status)
    class(hooke_integrator), intent(inout) :: self
    character(*), intent(in) :: path
    class(hooke_state), intent(inout) :: state
    character(*), intent(in), optional :: name
    integer, intent(out), optional :: status
    character(:), allocatable :: c_name
    if (self%is_missing(status, state)) return
    call to_c_if(name, c_name)
    call accept(c_checkpoint_read(to_c(path), c_name, self%address(), state%address()), status)
  end subroutine

  ! Takes some steps, without frames.
  subroutine step_some(self, state, steps, status)
    class(hooke_integrator), intent(inout) :: self
    class(hooke_state), intent(inout) :: state
    integer(c_int32_t), intent(in) :: steps
    integer, intent(out), optional :: status
    call self%step(state, int(steps, hooke_long), status)
  end subroutine

  subroutine step_many(self, state, steps, status)
    class(hooke_integrator), intent(inout) :: self
    class(hooke_state), intent(inout) :: state
    integer(hooke_long), intent(in) :: steps
    integer, intent(out), optional :: status
    if (self%is_missing(status, state)) return
    call accept(c_integrator_step(self%address(), state%address(), steps), status)
  end subroutine

  ! Takes some steps of the integrator's own motion, continuing from where the last call left it; step() with
  ! 0 steps begins one. States are stale until sync().
  subroutine advance_some(self, steps, status)
    class(hooke_integrator), intent(inout) :: self
    integer(c_int32_t), intent(in) :: steps
    integer, intent(out), optional :: status
    call self%advance(int(steps, hooke_long), status)
  end subroutine

  subroutine advance_many(self, steps, status)
    class(hooke_integrator), intent(inout) :: self
    integer(hooke_long), intent(in) :: steps
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_integrator_advance(self%address(), steps), status)
  end subroutine

  ! Positions and velocities (3, k) of k particles of the motion.
  subroutine get(self, particles, position, velocity, status)
    class(hooke_integrator), intent(inout) :: self
    integer, intent(in) :: particles(:)
    real(c_double), intent(inout), contiguous, optional :: position(:, :), velocity(:, :)
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (.not. fit(particles, position, velocity, status)) return
    call accept(c_integrator_get(self%address(), size(particles, kind=c_int64_t), zero_based(particles), position, &
      velocity), status)
  end subroutine

  ! Sets k particles of the motion to `position`, with `velocity`.
  subroutine put(self, particles, position, velocity, status)
    class(hooke_integrator), intent(inout) :: self
    integer, intent(in) :: particles(:)
    real(c_double), intent(in), contiguous, optional :: position(:, :), velocity(:, :)
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (.not. fit(particles, position, velocity, status)) return
    call accept(c_integrator_put(self%address(), size(particles, kind=c_int64_t), zero_based(particles), position, &
      velocity), status)
  end subroutine

  logical function fit(particles, position, velocity, status)
    integer, intent(in) :: particles(:)
    real(c_double), intent(in), optional :: position(:, :), velocity(:, :)
    integer, intent(out), optional :: status
    fit = .true.
    if (present(position)) fit = all(shape(position) == [3, size(particles)])
    if (present(velocity)) fit = fit .and. all(shape(velocity) == [3, size(particles)])
    if (.not. fit) call refuse(hooke_bad_value, "positions and velocities of k particles have the shape (3, k)", status)
  end function

  ! ---- counts since it was made ----

  impure elemental subroutine assign(self, other)
    class(hooke_integrator), intent(inout) :: self
    type(hooke_integrator), intent(in) :: other
    if (self%has_that_of(other)) return
    call self%share(other)
    self%options = other%options
  end subroutine

  subroutine destroy(self)
    class(hooke_integrator), intent(inout) :: self
    call self%options%destroy()
    call self%hooke_handle%destroy()
  end subroutine
end module
