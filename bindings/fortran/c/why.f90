! Made from include/hooke/why.h by make_interfaces.py.
module hooke_c_why
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_integrator_on_warning(integrator, warning, ctx) &
      bind(c, name="hooke_integrator_on_warning")
      import
      type(c_ptr), value :: integrator, ctx
      type(c_funptr), value :: warning
    end function
    integer(c_int32_t) function c_why_create(integrator, seconds, progress, ctx, why) bind(c, name="hooke_why_create")
      import
      type(c_ptr), value :: integrator, ctx
      real(c_double), value :: seconds
      type(c_funptr), value :: progress
      type(c_ptr), intent(out) :: why
    end function
    integer(c_int32_t) function c_why_create_kept(system, run, first, last, seconds, progress, ctx, why) &
      bind(c, name="hooke_why_create_kept")
      import
      type(c_ptr), value :: system, run, first, last, ctx
      real(c_double), value :: seconds
      type(c_funptr), value :: progress
      type(c_ptr), intent(out) :: why
    end function
    subroutine c_why_destroy(why) bind(c, name="hooke_why_destroy")
      import
      type(c_ptr), value :: why
    end subroutine
    type(c_ptr) function c_why_text(why, what) bind(c, name="hooke_why_text")
      import
      type(c_ptr), value :: why
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_why_number(why, what) bind(c, name="hooke_why_number")
      import
      type(c_ptr), value :: why
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_why_blame_count(why) bind(c, name="hooke_why_blame_count")
      import
      type(c_ptr), value :: why
    end function
    real(c_double) function c_why_blame_number(why, place, what) bind(c, name="hooke_why_blame_number")
      import
      type(c_ptr), value :: why
      integer(c_int64_t), value :: place
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_why_blame_text(why, place, what) bind(c, name="hooke_why_blame_text")
      import
      type(c_ptr), value :: why
      integer(c_int64_t), value :: place
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_why_advice_count(why) bind(c, name="hooke_why_advice_count")
      import
      type(c_ptr), value :: why
    end function
    type(c_ptr) function c_why_advice_text(why, place, what) bind(c, name="hooke_why_advice_text")
      import
      type(c_ptr), value :: why
      integer(c_int64_t), value :: place
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int32_t) function c_why_advice_apply(why, place, run) bind(c, name="hooke_why_advice_apply")
      import
      type(c_ptr), value :: why, run
      integer(c_int64_t), value :: place
    end function
  end interface
end module
