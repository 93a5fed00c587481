! Made from include/hooke/measurement.h by make_interfaces.py.
module hooke_c_measurement
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_measurement_create(kind, system, run, options, measurement) &
      bind(c, name="hooke_measurement_create")
      import
      character(kind=c_char), intent(in), optional :: kind(*)
      type(c_ptr), value :: system, run, options
      type(c_ptr), intent(out) :: measurement
    end function
    subroutine c_measurement_destroy(measurement) bind(c, name="hooke_measurement_destroy")
      import
      type(c_ptr), value :: measurement
    end subroutine
    type(c_ptr) function c_measurement_kind(measurement) bind(c, name="hooke_measurement_kind")
      import
      type(c_ptr), value :: measurement
    end function
    subroutine c_measurement_on_progress(measurement, progress, ctx) bind(c, name="hooke_measurement_on_progress")
      import
      type(c_ptr), value :: measurement, ctx
      type(c_funptr), value :: progress
    end subroutine
    integer(c_int32_t) function c_measurement_run(measurement, state) bind(c, name="hooke_measurement_run")
      import
      type(c_ptr), value :: measurement, state
    end function
    type(c_ptr) function c_measurement_table(kind, table, what) bind(c, name="hooke_measurement_table")
      import
      character(kind=c_char), intent(in), optional :: kind(*), what(*)
      integer(c_int64_t), value :: table
    end function
    type(c_ptr) function c_measurement_column(kind, table, column, what) bind(c, name="hooke_measurement_column")
      import
      character(kind=c_char), intent(in), optional :: kind(*), table(*), what(*)
      integer(c_int64_t), value :: column
    end function
    integer(c_int64_t) function c_measurement_row_count(measurement, table) bind(c, name="hooke_measurement_row_count")
      import
      type(c_ptr), value :: measurement
      character(kind=c_char), intent(in), optional :: table(*)
    end function
    real(c_double) function c_measurement_number(measurement, table, row, column) &
      bind(c, name="hooke_measurement_number")
      import
      type(c_ptr), value :: measurement
      character(kind=c_char), intent(in), optional :: table(*), column(*)
      integer(c_int64_t), value :: row
    end function
    type(c_ptr) function c_measurement_text(measurement, table, row, column) bind(c, name="hooke_measurement_text")
      import
      type(c_ptr), value :: measurement
      character(kind=c_char), intent(in), optional :: table(*), column(*)
      integer(c_int64_t), value :: row
    end function
    integer(c_int64_t) function c_measurement_series_count(measurement, table, row, column) &
      bind(c, name="hooke_measurement_series_count")
      import
      type(c_ptr), value :: measurement
      character(kind=c_char), intent(in), optional :: table(*), column(*)
      integer(c_int64_t), value :: row
    end function
    type(c_ptr) function c_measurement_series(measurement, table, row, column) bind(c, name="hooke_measurement_series")
      import
      type(c_ptr), value :: measurement
      character(kind=c_char), intent(in), optional :: table(*), column(*)
      integer(c_int64_t), value :: row
    end function
    integer(c_int32_t) function c_measurement_label(measurement, what, text) bind(c, name="hooke_measurement_label")
      import
      type(c_ptr), value :: measurement
      character(kind=c_char), intent(in), optional :: what(*), text(*)
    end function
    integer(c_int32_t) function c_measurement_write(measurement, path) bind(c, name="hooke_measurement_write")
      import
      type(c_ptr), value :: measurement
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int32_t) function c_comparison_on_frame(comparison, observer, ctx) &
      bind(c, name="hooke_comparison_on_frame")
      import
      type(c_ptr), value :: comparison, ctx
      type(c_funptr), value :: observer
    end function
    integer(c_int32_t) function c_comparison_file_create(path, comparison, file) &
      bind(c, name="hooke_comparison_file_create")
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), value :: comparison
      type(c_ptr), intent(out) :: file
    end function
    integer(c_int32_t) function c_comparison_file_close(file) bind(c, name="hooke_comparison_file_close")
      import
      type(c_ptr), value :: file
    end function
    type(c_ptr) function c_needs_lean(needs) bind(c, name="hooke_needs_lean")
      import
      type(c_ptr), value :: needs
    end function
    type(c_ptr) function c_needs_lean_run(needs) bind(c, name="hooke_needs_lean_run")
      import
      type(c_ptr), value :: needs
    end function
    integer(c_int64_t) function c_needs_lean_particle(needs, particle) bind(c, name="hooke_needs_lean_particle")
      import
      type(c_ptr), value :: needs
      integer(c_int64_t), value :: particle
    end function
    integer(c_int32_t) function c_needs_lean_position(needs, q, position) bind(c, name="hooke_needs_lean_position")
      import
      type(c_ptr), value :: needs
      real(c_double), intent(in), optional :: q(*)
      real(c_double), intent(inout), optional :: position(*)
    end function
    integer(c_int32_t) function c_verify_create(path, options, limits, verify) bind(c, name="hooke_verify_create")
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), value :: options, limits
      type(c_ptr), intent(out) :: verify
    end function
  end interface
end module
