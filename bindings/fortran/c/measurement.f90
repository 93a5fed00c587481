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
    real(c_double) function c_limit_of_mode(method, frequency, decay) bind(c, name="hooke_limit_of_mode")
      import
      character(kind=c_char), intent(in), optional :: method(*)
      real(c_double), value :: frequency, decay
    end function
    integer(c_int32_t) function c_why_create(integrator, options, measurement) bind(c, name="hooke_why_create")
      import
      type(c_ptr), value :: integrator, options
      type(c_ptr), intent(out) :: measurement
    end function
    integer(c_int32_t) function c_why_create_kept(system, run, first, last, options, measurement) &
      bind(c, name="hooke_why_create_kept")
      import
      type(c_ptr), value :: system, run, first, last, options
      type(c_ptr), intent(out) :: measurement
    end function
    integer(c_int32_t) function c_why_advice_apply(measurement, row, run) bind(c, name="hooke_why_advice_apply")
      import
      type(c_ptr), value :: measurement, run
      integer(c_int64_t), value :: row
    end function
  end interface
end module
