! Made from include/hooke/estimate.h by make_interfaces.py.
module hooke_c_estimate
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_estimate_create(system, want, estimate) bind(c, name="hooke_estimate_create")
      import
      type(c_ptr), value :: system
      real(c_double), value :: want
      type(c_ptr), intent(out) :: estimate
    end function
    subroutine c_estimate_destroy(estimate) bind(c, name="hooke_estimate_destroy")
      import
      type(c_ptr), value :: estimate
    end subroutine
    subroutine c_estimate_on_progress(estimate, progress, ctx) bind(c, name="hooke_estimate_on_progress")
      import
      type(c_ptr), value :: estimate, ctx
      type(c_funptr), value :: progress
    end subroutine
    integer(c_int32_t) function c_estimate_pick(estimate, method, run) bind(c, name="hooke_estimate_pick")
      import
      type(c_ptr), value :: estimate, run
      character(kind=c_char), intent(in), optional :: method(*)
    end function
    integer(c_int32_t) function c_estimate_begin(estimate, integrator, state) bind(c, name="hooke_estimate_begin")
      import
      type(c_ptr), value :: estimate, integrator, state
    end function
    integer(c_int32_t) function c_estimate_see(step, state, estimate) bind(c, name="hooke_estimate_see")
      import
      integer(c_int64_t), value :: step
      type(c_ptr), value :: state, estimate
    end function
    integer(c_int32_t) function c_estimate_measure(estimate, integrator, state) bind(c, name="hooke_estimate_measure")
      import
      type(c_ptr), value :: estimate, integrator, state
    end function
    integer(c_int32_t) function c_estimate_refine(estimate, run) bind(c, name="hooke_estimate_refine")
      import
      type(c_ptr), value :: estimate, run
    end function
    real(c_double) function c_estimate_number(estimate, what) bind(c, name="hooke_estimate_number")
      import
      type(c_ptr), value :: estimate
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_estimate_text(estimate, what) bind(c, name="hooke_estimate_text")
      import
      type(c_ptr), value :: estimate
      character(kind=c_char), intent(in), optional :: what(*)
    end function
  end interface
end module
