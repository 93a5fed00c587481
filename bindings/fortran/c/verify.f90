! Made from include/hooke/verify.h by make_interfaces.py.
module hooke_c_verify
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_verify_options_create(options) bind(c, name="hooke_verify_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_verify_create(path, options, limits, verify) bind(c, name="hooke_verify_create")
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), value :: options, limits
      type(c_ptr), intent(out) :: verify
    end function
    subroutine c_verify_destroy(verify) bind(c, name="hooke_verify_destroy")
      import
      type(c_ptr), value :: verify
    end subroutine
    subroutine c_verify_on_progress(verify, progress, ctx) bind(c, name="hooke_verify_on_progress")
      import
      type(c_ptr), value :: verify, ctx
      type(c_funptr), value :: progress
    end subroutine
    integer(c_int32_t) function c_verify_run(verify) bind(c, name="hooke_verify_run")
      import
      type(c_ptr), value :: verify
    end function
    type(c_ptr) function c_verify_text(verify, what) bind(c, name="hooke_verify_text")
      import
      type(c_ptr), value :: verify
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_verify_number(verify, what) bind(c, name="hooke_verify_number")
      import
      type(c_ptr), value :: verify
      character(kind=c_char), intent(in), optional :: what(*)
    end function
  end interface
end module
