! Made from include/hooke/measure.h by make_interfaces.py.
module hooke_c_measure
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_step_bound(system, method, q, bound) bind(c, name="hooke_step_bound")
      import
      type(c_ptr), value :: system
      character(kind=c_char), intent(in), optional :: method(*)
      real(c_double), intent(in), optional :: q(*)
      real(c_double), intent(inout), optional :: bound(*)
    end function
    integer(c_int32_t) function c_step_bounds(system, q, bounds) bind(c, name="hooke_step_bounds")
      import
      type(c_ptr), value :: system
      real(c_double), intent(in), optional :: q(*)
      real(c_double), intent(inout), optional :: bounds(*)
    end function
    integer(c_int32_t) function c_comparison_create(system, options, comparison) bind(c, name="hooke_comparison_create")
      import
      type(c_ptr), value :: system, options
      type(c_ptr), intent(out) :: comparison
    end function
    subroutine c_comparison_destroy(comparison) bind(c, name="hooke_comparison_destroy")
      import
      type(c_ptr), value :: comparison
    end subroutine
    integer(c_int32_t) function c_comparison_add(comparison, method) bind(c, name="hooke_comparison_add")
      import
      type(c_ptr), value :: comparison
      character(kind=c_char), intent(in), optional :: method(*)
    end function
    subroutine c_comparison_on_progress(comparison, progress, ctx) bind(c, name="hooke_comparison_on_progress")
      import
      type(c_ptr), value :: comparison, ctx
      type(c_funptr), value :: progress
    end subroutine
    subroutine c_comparison_on_frame(comparison, observer, ctx) bind(c, name="hooke_comparison_on_frame")
      import
      type(c_ptr), value :: comparison, ctx
      type(c_funptr), value :: observer
    end subroutine
    integer(c_int32_t) function c_comparison_run(comparison) bind(c, name="hooke_comparison_run")
      import
      type(c_ptr), value :: comparison
    end function
    integer(c_int64_t) function c_comparison_row_count(comparison) bind(c, name="hooke_comparison_row_count")
      import
      type(c_ptr), value :: comparison
    end function
    type(c_ptr) function c_comparison_text(comparison, row, what) bind(c, name="hooke_comparison_text")
      import
      type(c_ptr), value :: comparison
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_comparison_number(comparison, row, what) bind(c, name="hooke_comparison_number")
      import
      type(c_ptr), value :: comparison
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_comparison_reference(comparison) bind(c, name="hooke_comparison_reference")
      import
      type(c_ptr), value :: comparison
    end function
    integer(c_int64_t) function c_comparison_frame_count(comparison) bind(c, name="hooke_comparison_frame_count")
      import
      type(c_ptr), value :: comparison
    end function
    type(c_ptr) function c_comparison_series(comparison, row, what) bind(c, name="hooke_comparison_series")
      import
      type(c_ptr), value :: comparison
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
  end interface
end module
