! Made from include/hooke/system.h by make_interfaces.py.
module hooke_c_system
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_system_create(system) bind(c, name="hooke_system_create")
      import
      type(c_ptr), intent(out) :: system
    end function
    subroutine c_system_destroy(system) bind(c, name="hooke_system_destroy")
      import
      type(c_ptr), value :: system
    end subroutine
    integer(c_int32_t) function c_system_limit_memory(system, bytes) bind(c, name="hooke_system_limit_memory")
      import
      type(c_ptr), value :: system
      real(c_double), value :: bytes
    end function
    integer(c_int32_t) function c_system_add_particles(system, count, position, velocity, mass_count, mass, first) &
      bind(c, name="hooke_system_add_particles")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: count, mass_count
      real(c_double), intent(in), optional :: position(*), velocity(*), mass(*)
      integer(c_int64_t), intent(inout), optional :: first(*)
    end function
    integer(c_int32_t) function c_system_pin(system, count, particles) bind(c, name="hooke_system_pin")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: particles(*)
    end function
    integer(c_int32_t) function c_spring_options_create(options) bind(c, name="hooke_spring_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_system_add_springs(system, name, count, ends, options) &
      bind(c, name="hooke_system_add_springs")
      import
      type(c_ptr), value :: system, options
      character(kind=c_char), intent(in), optional :: name(*)
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: ends(*)
    end function
    integer(c_int32_t) function c_system_add_bending(system, name, count, triples, coefficient_count, coefficient) &
      bind(c, name="hooke_system_add_bending")
      import
      type(c_ptr), value :: system
      character(kind=c_char), intent(in), optional :: name(*)
      integer(c_int64_t), value :: count, coefficient_count
      integer(c_int64_t), intent(in), optional :: triples(*)
      real(c_double), intent(in), optional :: coefficient(*)
    end function
    integer(c_int32_t) function c_altitude_options_create(options) bind(c, name="hooke_altitude_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_system_add_altitude(system, name, count, tetrahedra, options) &
      bind(c, name="hooke_system_add_altitude")
      import
      type(c_ptr), value :: system, options
      character(kind=c_char), intent(in), optional :: name(*)
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: tetrahedra(*)
    end function
    integer(c_int32_t) function c_anchor_options_create(options) bind(c, name="hooke_anchor_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_system_add_anchors(system, name, count, particles, options) &
      bind(c, name="hooke_system_add_anchors")
      import
      type(c_ptr), value :: system, options
      character(kind=c_char), intent(in), optional :: name(*)
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: particles(*)
    end function
    integer(c_int32_t) function c_system_set_gravity(system, gravity) bind(c, name="hooke_system_set_gravity")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: gravity(*)
    end function
    integer(c_int32_t) function c_system_set_drag(system, coefficient) bind(c, name="hooke_system_set_drag")
      import
      type(c_ptr), value :: system
      real(c_double), value :: coefficient
    end function
    integer(c_int32_t) function c_system_set_force(system, force, product, ctx) bind(c, name="hooke_system_set_force")
      import
      type(c_ptr), value :: system, ctx
      type(c_funptr), value :: force, product
    end function
    integer(c_int32_t) function c_system_drive_harmonic(system, count, particles, amplitude, frequency, phase) &
      bind(c, name="hooke_system_drive_harmonic")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: particles(*)
      real(c_double), intent(in), optional :: amplitude(*)
      real(c_double), value :: frequency, phase
    end function
    integer(c_int32_t) function c_system_drive_table(system, count, particles, samples, time, displacement) &
      bind(c, name="hooke_system_drive_table")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: count, samples
      integer(c_int64_t), intent(in), optional :: particles(*)
      real(c_double), intent(in), optional :: time(*), displacement(*)
    end function
    integer(c_int32_t) function c_system_drive_callback(system, count, particles, drive, ctx) &
      bind(c, name="hooke_system_drive_callback")
      import
      type(c_ptr), value :: system, ctx
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in), optional :: particles(*)
      type(c_funptr), value :: drive
    end function
    integer(c_int32_t) function c_system_commit(system) bind(c, name="hooke_system_commit")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int32_t) function c_system_is_committed(system) bind(c, name="hooke_system_is_committed")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_particle_count(system) bind(c, name="hooke_system_particle_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_free_count(system) bind(c, name="hooke_system_free_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_spring_count(system) bind(c, name="hooke_system_spring_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_dropped_spring_count(system) bind(c, name="hooke_system_dropped_spring_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_idle_count(system) bind(c, name="hooke_system_idle_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_group_count(system) bind(c, name="hooke_system_group_count")
      import
      type(c_ptr), value :: system
    end function
    type(c_ptr) function c_system_group_name(system, group) bind(c, name="hooke_system_group_name")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: group
    end function
    integer(c_int64_t) function c_system_group_size(system, group) bind(c, name="hooke_system_group_size")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: group
    end function
    type(c_ptr) function c_system_mass(system) bind(c, name="hooke_system_mass")
      import
      type(c_ptr), value :: system
    end function
    type(c_ptr) function c_system_inverse_mass(system) bind(c, name="hooke_system_inverse_mass")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int32_t) function c_system_spring_ends(system, ends) bind(c, name="hooke_system_spring_ends")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), intent(inout), optional :: ends(*)
    end function
    integer(c_int32_t) function c_system_spring_material(system, kappa, gamma, rest_length) &
      bind(c, name="hooke_system_spring_material")
      import
      type(c_ptr), value :: system
      real(c_double), intent(inout), optional :: kappa(*), gamma(*), rest_length(*)
    end function
    integer(c_int64_t) function c_system_bending_count(system) bind(c, name="hooke_system_bending_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_bending_group_count(system) bind(c, name="hooke_system_bending_group_count")
      import
      type(c_ptr), value :: system
    end function
    type(c_ptr) function c_system_bending_group_name(system, group) bind(c, name="hooke_system_bending_group_name")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: group
    end function
    integer(c_int64_t) function c_system_bending_group_size(system, group) &
      bind(c, name="hooke_system_bending_group_size")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: group
    end function
    integer(c_int32_t) function c_system_bending_ends(system, triples) bind(c, name="hooke_system_bending_ends")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), intent(inout), optional :: triples(*)
    end function
    integer(c_int32_t) function c_system_bending_coefficient(system, coefficient) &
      bind(c, name="hooke_system_bending_coefficient")
      import
      type(c_ptr), value :: system
      real(c_double), intent(inout), optional :: coefficient(*)
    end function
    integer(c_int64_t) function c_system_altitude_count(system) bind(c, name="hooke_system_altitude_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_altitude_group_count(system) bind(c, name="hooke_system_altitude_group_count")
      import
      type(c_ptr), value :: system
    end function
    type(c_ptr) function c_system_altitude_group_name(system, group) bind(c, name="hooke_system_altitude_group_name")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: group
    end function
    integer(c_int64_t) function c_system_altitude_group_size(system, group) &
      bind(c, name="hooke_system_altitude_group_size")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: group
    end function
    integer(c_int32_t) function c_system_altitude_ends(system, tetrahedra) bind(c, name="hooke_system_altitude_ends")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), intent(inout), optional :: tetrahedra(*)
    end function
    integer(c_int32_t) function c_system_altitude_material(system, stiffness, damping, rest_length) &
      bind(c, name="hooke_system_altitude_material")
      import
      type(c_ptr), value :: system
      real(c_double), intent(inout), optional :: stiffness(*), damping(*), rest_length(*)
    end function
    integer(c_int32_t) function c_system_altitude_lengths(system, q, length) &
      bind(c, name="hooke_system_altitude_lengths")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*)
      real(c_double), intent(inout), optional :: length(*)
    end function
    integer(c_int64_t) function c_system_anchor_count(system) bind(c, name="hooke_system_anchor_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int32_t) function c_system_anchors(system, particles, points, stiffness, damping, rest_length) &
      bind(c, name="hooke_system_anchors")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), intent(inout), optional :: particles(*)
      real(c_double), intent(inout), optional :: points(*), stiffness(*), damping(*), rest_length(*)
    end function
    integer(c_int64_t) function c_system_derived_count(system) bind(c, name="hooke_system_derived_count")
      import
      type(c_ptr), value :: system
    end function
    type(c_ptr) function c_system_derived_text(system, number, what) bind(c, name="hooke_system_derived_text")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: number
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_system_derived_value(system, number) bind(c, name="hooke_system_derived_value")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: number
    end function
    integer(c_int64_t) function c_system_force_count(system) bind(c, name="hooke_system_force_count")
      import
      type(c_ptr), value :: system
    end function
    type(c_ptr) function c_system_force_name(system, force) bind(c, name="hooke_system_force_name")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), value :: force
    end function
    integer(c_int64_t) function c_system_memory(system) bind(c, name="hooke_system_memory")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int64_t) function c_system_spring_memory(system) bind(c, name="hooke_system_spring_memory")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int32_t) function c_system_force(system, t, q, v, force) bind(c, name="hooke_system_force")
      import
      type(c_ptr), value :: system
      real(c_double), value :: t
      real(c_double), intent(in), optional :: q(*), v(*)
      real(c_double), intent(inout), optional :: force(*)
    end function
    integer(c_int32_t) function c_system_acceleration(system, t, q, v, acceleration) &
      bind(c, name="hooke_system_acceleration")
      import
      type(c_ptr), value :: system
      real(c_double), value :: t
      real(c_double), intent(in), optional :: q(*), v(*)
      real(c_double), intent(inout), optional :: acceleration(*)
    end function
    integer(c_int64_t) function c_system_coincident_springs(system, q) bind(c, name="hooke_system_coincident_springs")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*)
    end function
    integer(c_int32_t) function c_system_derivative_product(system, t, q, v, dq, dv, out) &
      bind(c, name="hooke_system_derivative_product")
      import
      type(c_ptr), value :: system
      real(c_double), value :: t
      real(c_double), intent(in), optional :: q(*), v(*), dq(*), dv(*)
      real(c_double), intent(inout), optional :: out(*)
    end function
    integer(c_int64_t) function c_system_block_count(system) bind(c, name="hooke_system_block_count")
      import
      type(c_ptr), value :: system
    end function
    integer(c_int32_t) function c_system_derivative_pattern(system, row_start, column) &
      bind(c, name="hooke_system_derivative_pattern")
      import
      type(c_ptr), value :: system
      integer(c_int64_t), intent(inout), optional :: row_start(*), column(*)
    end function
    integer(c_int32_t) function c_system_derivative_blocks(system, q, v, dfdq, dfdv) &
      bind(c, name="hooke_system_derivative_blocks")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*), v(*)
      real(c_double), intent(inout), optional :: dfdq(*), dfdv(*)
    end function
    real(c_double) function c_system_kinetic_energy(system, v) bind(c, name="hooke_system_kinetic_energy")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: v(*)
    end function
    real(c_double) function c_system_spring_energy(system, q) bind(c, name="hooke_system_spring_energy")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*)
    end function
    real(c_double) function c_system_bending_energy(system, q) bind(c, name="hooke_system_bending_energy")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*)
    end function
    real(c_double) function c_system_altitude_energy(system, q) bind(c, name="hooke_system_altitude_energy")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*)
    end function
    real(c_double) function c_system_gravity_energy(system, q) bind(c, name="hooke_system_gravity_energy")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*)
    end function
    real(c_double) function c_system_potential_energy(system, q) bind(c, name="hooke_system_potential_energy")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*)
    end function
    real(c_double) function c_system_energy(system, q, v) bind(c, name="hooke_system_energy")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*), v(*)
    end function
    real(c_double) function c_system_dissipated_power(system, q, v) bind(c, name="hooke_system_dissipated_power")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*), v(*)
    end function
    subroutine c_system_momentum(system, v, momentum) bind(c, name="hooke_system_momentum")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: v(*)
      real(c_double), intent(inout), optional :: momentum(*)
    end subroutine
    subroutine c_system_angular_momentum(system, q, v, angular_momentum) bind(c, name="hooke_system_angular_momentum")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*), v(*)
      real(c_double), intent(inout), optional :: angular_momentum(*)
    end subroutine
  end interface
end module
