! Made from include/hooke/limit.h by make_interfaces.py.
module hooke_c_limit
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_limit_options_create(options) bind(c, name="hooke_limit_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_limit_create(system, run, options, limit) bind(c, name="hooke_limit_create")
      import
      type(c_ptr), value :: system, run, options
      type(c_ptr), intent(out) :: limit
    end function
    subroutine c_limit_destroy(limit) bind(c, name="hooke_limit_destroy")
      import
      type(c_ptr), value :: limit
    end subroutine
    subroutine c_limit_on_progress(limit, progress, ctx) bind(c, name="hooke_limit_on_progress")
      import
      type(c_ptr), value :: limit, ctx
      type(c_funptr), value :: progress
    end subroutine
    integer(c_int32_t) function c_limit_find(limit, state) bind(c, name="hooke_limit_find")
      import
      type(c_ptr), value :: limit, state
    end function
    integer(c_int32_t) function c_limit_along(limit, state) bind(c, name="hooke_limit_along")
      import
      type(c_ptr), value :: limit, state
    end function
    real(c_double) function c_limit_figure(limit, what) bind(c, name="hooke_limit_figure")
      import
      type(c_ptr), value :: limit
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_limit_row_count(limit) bind(c, name="hooke_limit_row_count")
      import
      type(c_ptr), value :: limit
    end function
    type(c_ptr) function c_limit_text(limit, row, what) bind(c, name="hooke_limit_text")
      import
      type(c_ptr), value :: limit
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_limit_number(limit, row, what) bind(c, name="hooke_limit_number")
      import
      type(c_ptr), value :: limit
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_limit_blame_count(limit) bind(c, name="hooke_limit_blame_count")
      import
      type(c_ptr), value :: limit
    end function
    real(c_double) function c_limit_blame_number(limit, place, what) bind(c, name="hooke_limit_blame_number")
      import
      type(c_ptr), value :: limit
      integer(c_int64_t), value :: place
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_limit_blame_text(limit, place, what) bind(c, name="hooke_limit_blame_text")
      import
      type(c_ptr), value :: limit
      integer(c_int64_t), value :: place
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_limit_mover_count(limit) bind(c, name="hooke_limit_mover_count")
      import
      type(c_ptr), value :: limit
    end function
    real(c_double) function c_limit_mover_number(limit, place, what) bind(c, name="hooke_limit_mover_number")
      import
      type(c_ptr), value :: limit
      integer(c_int64_t), value :: place
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_limit_remedy_text(limit, what) bind(c, name="hooke_limit_remedy_text")
      import
      type(c_ptr), value :: limit
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_limit_remedy_number(limit, what) bind(c, name="hooke_limit_remedy_number")
      import
      type(c_ptr), value :: limit
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_limit_mode_count(limit) bind(c, name="hooke_limit_mode_count")
      import
      type(c_ptr), value :: limit
    end function
    real(c_double) function c_limit_mode_number(limit, mode, what) bind(c, name="hooke_limit_mode_number")
      import
      type(c_ptr), value :: limit
      integer(c_int64_t), value :: mode
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_limit_shape(limit) bind(c, name="hooke_limit_shape")
      import
      type(c_ptr), value :: limit
    end function
    real(c_double) function c_limit_of_mode(method, frequency, decay) bind(c, name="hooke_limit_of_mode")
      import
      character(kind=c_char), intent(in), optional :: method(*)
      real(c_double), value :: frequency, decay
    end function
  end interface
end module
