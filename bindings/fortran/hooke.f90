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
! reference to the same object; copy_to(), where it exists, copies.
module hooke
  use hooke_base, only: hooke_real, hooke_long, &
    hooke_ok, hooke_stopped, hooke_diverged, hooke_step_limit, hooke_no_memory, hooke_bad_value, hooke_bad_call, &
    hooke_io_failed, hooke_not_built, hooke_unsuited, hooke_solver_failed, hooke_internal, &
    hooke_message => message, hooke_status_name => status_name
  use hooke_estimates, only: hooke_estimate
  use hooke_forces, only: hooke_force, hooke_force_with_product, hooke_coordinate_force, hooke_coordinate_force_with_product, &
    hooke_drive, hooke_rate
  use hooke_integrators, only: hooke_integrator, hooke_system_warnings
  use hooke_measurements, only: hooke_measurement
  use hooke_observers, only: hooke_observer, hooke_progress, hooke_warning
  use hooke_option_tables, only: hooke_options
  use hooke_queries_of_library, only: hooke_version => version, hooke_abi => abi, hooke_build_fact => build_fact, &
    hooke_part_kind => part_kind, hooke_method_count => method_count, hooke_method_name => method_name, &
    hooke_method_meant => method_meant, hooke_method_summary => method_summary, &
    hooke_method_is_adaptive => method_is_adaptive, hooke_method_is_built => method_is_built, &
    hooke_method_is_suited => method_is_suited, hooke_measurement_table => measurement_table, &
    hooke_measurement_column => measurement_column, hooke_limit_of_mode => limit_of_mode, hooke_own_process => io_own_process
  use hooke_scenes, only: hooke_scene
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system, hooke_rows_hold => rows_hold
  use hooke_trajectories, only: hooke_trajectory, hooke_record
  use hooke_views, only: hooke_view
  implicit none
  public
end module
