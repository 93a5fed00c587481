! Methods, and the loop that runs them.
module hooke_integrators
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_funptr, c_int32_t, c_int64_t, c_loc, c_null_funptr, &
    c_ptr
  use hooke_base, only: accept, hooke_bad_value, hooke_long, refuse, zero_based
  use hooke_c_integrator
  use hooke_forces
  use hooke_handles, only: called_object, callback_to, hooke_callback
  use hooke_queries_of_integrator
  use hooke_observers
  use hooke_option_tables, only: hooke_options
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_integrator, hooke_system_warnings

  integer, parameter :: of_coordinates = 1

  type, extends(hooke_integrator_queries) :: hooke_integrator
    ! Its own copy of its options, with defaults filled in.
    type(hooke_options) :: options
  contains
    procedure :: create_second_order
    procedure, private :: step_some, step_many
    generic :: step => step_some, step_many
    procedure, private :: advance_some, advance_many
    generic :: advance => advance_some, advance_many
    procedure :: get
    procedure :: put
    procedure :: refresh
  end type

contains

  ! ---- making ----

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
      product = c_funloc(call_coordinate_force_with_product)
    end select
    code = c_integrator_create_second_order(int(size, c_int64_t), callback%function, product, callback%data, &
      ubound(inverse_mass, 1, c_int64_t), inverse_mass, options%address(), integrator)
    if (code == 0) call self%take(integrator, c_integrator_destroy)
    call self%keep(callback, of_coordinates, code, status)
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

  subroutine refresh(self)
    class(hooke_integrator), intent(inout) :: self
    call self%options%destroy()
    if (self%exists()) call self%options%take(c_integrator_options(self%address()), owner=self)
  end subroutine
end module
