! Made from include/hooke/cost.h by make_interfaces.py.
module hooke_c_cost
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_cost_options_create(options) bind(c, name="hooke_cost_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_cost_create(system, run, options, cost) bind(c, name="hooke_cost_create")
      import
      type(c_ptr), value :: system, run, options
      type(c_ptr), intent(out) :: cost
    end function
    subroutine c_cost_destroy(cost) bind(c, name="hooke_cost_destroy")
      import
      type(c_ptr), value :: cost
    end subroutine
    subroutine c_cost_on_progress(cost, progress, ctx) bind(c, name="hooke_cost_on_progress")
      import
      type(c_ptr), value :: cost, ctx
      type(c_funptr), value :: progress
    end subroutine
    integer(c_int32_t) function c_cost_find(cost, state) bind(c, name="hooke_cost_find")
      import
      type(c_ptr), value :: cost, state
    end function
    type(c_ptr) function c_cost_method(cost) bind(c, name="hooke_cost_method")
      import
      type(c_ptr), value :: cost
    end function
    real(c_double) function c_cost_figure(cost, what) bind(c, name="hooke_cost_figure")
      import
      type(c_ptr), value :: cost
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_cost_row_count(cost) bind(c, name="hooke_cost_row_count")
      import
      type(c_ptr), value :: cost
    end function
    type(c_ptr) function c_cost_text(cost, row, what) bind(c, name="hooke_cost_text")
      import
      type(c_ptr), value :: cost
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_cost_number(cost, row, what) bind(c, name="hooke_cost_number")
      import
      type(c_ptr), value :: cost
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
  end interface
end module
