! Building a system: particles, springs, bending, parts, forces, motions; the last call is commit().
module hooke_builders
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_ptr
  use hooke_base, only: accept, hooke_bad_value, refuse, to_c, to_c_if, zero_based
  use hooke_c_parts
  use hooke_c_system
  use hooke_forces
  use hooke_handles, only: callback_to, hooke_callback
  use hooke_option_tables, only: hooke_options
  use hooke_queries_of_system
  implicit none
  private
  public :: hooke_builder

  integer, parameter :: place_of_force = 1

  ! The procedures of hooke_system that are allowed until it is committed.
  type, extends(hooke_system_queries) :: hooke_builder
  contains
    procedure, private :: add_particles_alike, add_particles_each
    generic :: add_particles => add_particles_alike, add_particles_each
    procedure, private :: pin_one, pin_some
    generic :: pin => pin_one, pin_some
    procedure, private :: add_bending_alike, add_bending_each
    generic :: add_bending => add_bending_alike, add_bending_each
    procedure :: add_body
    procedure :: add_part
    procedure :: set_gravity
    procedure :: set_force
    procedure :: with_force
    procedure :: drive_harmonic
    procedure :: drive_table
    procedure :: drive_callback
  end type

contains

  ! Adds particles at position(3, n) [m], all of one mass [kg], at rest or with velocity(3, n) [m/s]; `first` is the
  ! number of the first of them.
  subroutine add_particles_alike(self, position, mass, velocity, first, status)
    class(hooke_builder), intent(inout) :: self
    real(c_double), intent(in), contiguous :: position(:, :)
    real(c_double), intent(in) :: mass
    real(c_double), intent(in), contiguous, optional :: velocity(:, :)
    integer, intent(out), optional :: first, status
    if (present(velocity)) then
      call self%add_particles(position, [mass], velocity, first, status)
    else
      call self%add_particles(position, [mass], first=first, status=status)
    end if
  end subroutine

  ! The same with a mass for each.
  subroutine add_particles_each(self, position, mass, velocity, first, status)
    class(hooke_builder), intent(inout) :: self
    real(c_double), intent(in), contiguous :: position(:, :), mass(:)
    real(c_double), intent(in), contiguous, optional :: velocity(:, :)
    integer, intent(out), optional :: first, status
    integer(c_int64_t) :: count, number(1)
    integer(c_int32_t) :: code
    logical :: fits
    if (present(first)) first = 0
    if (self%is_missing(status)) return
    fits = size(position, 1) == 3
    if (present(velocity)) fits = fits .and. all(shape(velocity) == shape(position))
    if (.not. fits) then
      call refuse(hooke_bad_value, "positions and velocities of particles have the shape (3, n)", status)
      return
    end if
    number = -1
    count = size(position, 2, c_int64_t)
    if (present(velocity)) then
      code = c_system_add_particles(self%address(), count, position, velocity, size(mass, kind=c_int64_t), mass, number)
    else
      code = c_system_add_particles(self%address(), count, position, mass_count=size(mass, kind=c_int64_t), mass=mass, &
        first=number)
    end if
    call accept(code, status)
    if (present(first)) first = int(number(1)) + 1
  end subroutine

  subroutine pin_one(self, particle, status)
    class(hooke_builder), intent(inout) :: self
    integer, intent(in) :: particle
    integer, intent(out), optional :: status
    call self%pin([particle], status)
  end subroutine

  ! Pins particles.
  subroutine pin_some(self, particles, status)
    class(hooke_builder), intent(inout) :: self
    integer, intent(in) :: particles(:)
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_system_pin(self%address(), size(particles, kind=c_int64_t), zero_based(particles)), status)
  end subroutine

  subroutine add_bending_alike(self, triples, coefficient, name, status)
    class(hooke_builder), intent(inout) :: self
    integer, intent(in) :: triples(:, :)
    real(c_double), intent(in) :: coefficient
    character(*), intent(in), optional :: name
    integer, intent(out), optional :: status
    call self%add_bending(triples, [coefficient], name, status)
  end subroutine

  ! Adds bending on triples(3, n) of particles, with one coefficient [N/m] or n.
  subroutine add_bending_each(self, triples, coefficient, name, status)
    class(hooke_builder), intent(inout) :: self
    integer, intent(in) :: triples(:, :)
    real(c_double), intent(in), contiguous :: coefficient(:)
    character(*), intent(in), optional :: name
    integer, intent(out), optional :: status
    character(:), allocatable :: c_name
    if (self%is_missing(status)) return
    if (size(triples, 1) /= 3) then
      call refuse(hooke_bad_value, "triples of bending have the shape (3, n)", status)
      return
    end if
    call to_c_if(name, c_name)
    call accept(c_system_add_bending(self%address(), c_name, size(triples, 2, c_int64_t), zero_based(triples), &
      size(coefficient, kind=c_int64_t), coefficient), status)
  end subroutine

  ! Makes particles one rigid body; with `project` initial velocities become those of the nearest rigid motion.
  subroutine add_body(self, particles, name, project, status)
    class(hooke_builder), intent(inout) :: self
    integer, intent(in) :: particles(:)
    character(*), intent(in), optional :: name
    logical, intent(in), optional :: project
    integer, intent(out), optional :: status
    character(:), allocatable :: c_name
    integer(c_int32_t) :: projected
    if (self%is_missing(status)) return
    call to_c_if(name, c_name)
    projected = 0
    if (present(project)) projected = merge(1_c_int32_t, 0_c_int32_t, project)
    call accept(c_system_add_body(self%address(), c_name, size(particles, kind=c_int64_t), zero_based(particles), &
      projected), status)
  end subroutine

  ! Adds a generated part; `first` and `count` are its particles.
  subroutine add_part(self, kind, options, name, first, count, status)
    class(hooke_builder), intent(inout) :: self
    character(*), intent(in) :: kind
    type(hooke_options), intent(in) :: options
    character(*), intent(in), optional :: name
    integer, intent(out), optional :: first, count, status
    character(:), allocatable :: c_name
    integer(c_int64_t) :: number(1), particles(1)
    if (present(first)) first = 0
    if (present(count)) count = 0
    if (self%is_missing(status, options)) return
    number = -1
    particles = 0
    call to_c_if(name, c_name)
    call accept(c_system_add_part(self%address(), to_c(kind), c_name, options%address(), number, particles), status)
    if (present(first)) first = int(number(1)) + 1
    if (present(count)) count = int(particles(1))
  end subroutine

  ! Acceleration of every free particle [m/s^2].
  subroutine set_gravity(self, gravity, status)
    class(hooke_builder), intent(inout) :: self
    real(c_double), intent(in) :: gravity(3)
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_system_set_gravity(self%address(), gravity), status)
  end subroutine

  ! A callback force, which must exist as long as the system is used.
  subroutine set_force(self, force, status)
    class(hooke_builder), intent(inout) :: self
    class(hooke_force), target, intent(inout) :: force
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_force), force)
    call self%keep(callback, place_of_force, &
      c_system_set_force(self%address(), callback%function, product_of(force), callback%data), status)
  end subroutine

  type(c_funptr) function product_of(force)
    class(hooke_force), intent(in) :: force
    product_of = c_null_funptr
    select type (force)
    class is (hooke_force_with_product)
      product_of = c_funloc(call_force_with_product)
    end select
  end function

  ! `forced` becomes this committed system with a callback force, which must exist as long as it is used; they share
  ! the rest.
  subroutine with_force(self, force, forced, status)
    class(hooke_builder), intent(in) :: self
    class(hooke_force), target, intent(inout) :: force
    class(hooke_builder), intent(inout) :: forced
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    type(c_ptr) :: made
    integer(c_int32_t) :: code
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_force), force)
    code = c_system_with_force(self%address(), callback%function, product_of(force), callback%data, made)
    if (code == 0) call forced%take(made, c_system_destroy, self)
    call forced%keep(callback, place_of_force, code, status)
  end subroutine

  ! Particles driven about their initial positions: by amplitude(3) sin(2 pi frequency t + phase), in m, Hz
  ! and rad;
  subroutine drive_harmonic(self, particles, amplitude, frequency, phase, status)
    class(hooke_builder), intent(inout) :: self
    integer, intent(in) :: particles(:)
    real(c_double), intent(in) :: amplitude(3), frequency
    real(c_double), intent(in), optional :: phase
    integer, intent(out), optional :: status
    real(c_double) :: angle
    if (self%is_missing(status)) return
    angle = 0
    if (present(phase)) angle = phase
    call accept(c_system_drive_harmonic(self%address(), size(particles, kind=c_int64_t), zero_based(particles), &
      amplitude, frequency, angle), status)
  end subroutine

  ! by displacement(3, samples) [m] at ascending time(samples) [s], piecewise cubic in between;
  subroutine drive_table(self, particles, time, displacement, status)
    class(hooke_builder), intent(inout) :: self
    integer, intent(in) :: particles(:)
    real(c_double), intent(in), contiguous :: time(:), displacement(:, :)
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (size(displacement, 1) /= 3 .or. size(displacement, 2) /= size(time)) then
      call refuse(hooke_bad_value, "displacements at n times have the shape (3, n)", status)
      return
    end if
    call accept(c_system_drive_table(self%address(), size(particles, kind=c_int64_t), zero_based(particles), &
      size(time, kind=c_int64_t), time, displacement), status)
  end subroutine

  ! or by `drive`, which must exist as long as the system is used.
  subroutine drive_callback(self, particles, drive, status)
    class(hooke_builder), intent(inout) :: self
    integer, intent(in) :: particles(:)
    class(hooke_drive), target, intent(inout) :: drive
    integer, intent(out), optional :: status
    type(hooke_callback) :: callback
    if (self%is_missing(status)) return
    callback = callback_to(c_funloc(call_drive), drive)
    call self%keep(callback, 0, c_system_drive_callback(self%address(), size(particles, kind=c_int64_t), &
      zero_based(particles), callback%function, callback%data), status)
  end subroutine

end module
