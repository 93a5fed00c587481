! Made from include/hooke/integrator.h by make_interfaces.py.
module hooke_c_integrator
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int64_t) function c_method_count() bind(c, name="hooke_method_count")
      import
    end function
    type(c_ptr) function c_method_name(method) bind(c, name="hooke_method_name")
      import
      integer(c_int64_t), value :: method
    end function
    type(c_ptr) function c_method_summary(name) bind(c, name="hooke_method_summary")
      import
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    integer(c_int32_t) function c_method_is_adaptive(name) bind(c, name="hooke_method_is_adaptive")
      import
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    integer(c_int32_t) function c_method_is_built(name) bind(c, name="hooke_method_is_built")
      import
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    integer(c_int32_t) function c_run_options_create(options) bind(c, name="hooke_run_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_integrator_create(system, options, integrator) bind(c, name="hooke_integrator_create")
      import
      type(c_ptr), value :: system, options
      type(c_ptr), intent(out) :: integrator
    end function
    integer(c_int32_t) function c_integrator_create_first_order(size, rate, ctx, options, integrator) &
      bind(c, name="hooke_integrator_create_first_order")
      import
      integer(c_int64_t), value :: size
      type(c_funptr), value :: rate
      type(c_ptr), value :: ctx, options
      type(c_ptr), intent(out) :: integrator
    end function
    subroutine c_integrator_destroy(integrator) bind(c, name="hooke_integrator_destroy")
      import
      type(c_ptr), value :: integrator
    end subroutine
    type(c_ptr) function c_integrator_options(integrator) bind(c, name="hooke_integrator_options")
      import
      type(c_ptr), value :: integrator
    end function
    integer(c_int32_t) function c_integrator_on_frame(integrator, observer, ctx) &
      bind(c, name="hooke_integrator_on_frame")
      import
      type(c_ptr), value :: integrator, ctx
      type(c_funptr), value :: observer
    end function
    integer(c_int32_t) function c_integrator_on_step(integrator, stride, observer, ctx) &
      bind(c, name="hooke_integrator_on_step")
      import
      type(c_ptr), value :: integrator, ctx
      integer(c_int64_t), value :: stride
      type(c_funptr), value :: observer
    end function
    integer(c_int32_t) function c_integrator_on_checkpoint(integrator, observer, ctx) &
      bind(c, name="hooke_integrator_on_checkpoint")
      import
      type(c_ptr), value :: integrator, ctx
      type(c_funptr), value :: observer
    end function
    integer(c_int32_t) function c_integrator_on_progress(integrator, seconds, progress, ctx) &
      bind(c, name="hooke_integrator_on_progress")
      import
      type(c_ptr), value :: integrator, ctx
      real(c_double), value :: seconds
      type(c_funptr), value :: progress
    end function
    integer(c_int64_t) function c_integrator_frame_count(integrator) bind(c, name="hooke_integrator_frame_count")
      import
      type(c_ptr), value :: integrator
    end function
    integer(c_int32_t) function c_integrator_run(integrator, state) bind(c, name="hooke_integrator_run")
      import
      type(c_ptr), value :: integrator, state
    end function
    integer(c_int32_t) function c_integrator_resume(integrator, state) bind(c, name="hooke_integrator_resume")
      import
      type(c_ptr), value :: integrator, state
    end function
    integer(c_int32_t) function c_integrator_step(integrator, state, steps) bind(c, name="hooke_integrator_step")
      import
      type(c_ptr), value :: integrator, state
      integer(c_int64_t), value :: steps
    end function
    integer(c_int64_t) function c_integrator_count(integrator, what) bind(c, name="hooke_integrator_count")
      import
      type(c_ptr), value :: integrator
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_integrator_wall_seconds(integrator) bind(c, name="hooke_integrator_wall_seconds")
      import
      type(c_ptr), value :: integrator
    end function
    integer(c_int64_t) function c_integrator_recent_count(integrator) bind(c, name="hooke_integrator_recent_count")
      import
      type(c_ptr), value :: integrator
    end function
    integer(c_int32_t) function c_integrator_recent(integrator, place, state) bind(c, name="hooke_integrator_recent")
      import
      type(c_ptr), value :: integrator, state
      integer(c_int64_t), value :: place
    end function
    integer(c_int32_t) function c_integrator_stop_value(integrator) bind(c, name="hooke_integrator_stop_value")
      import
      type(c_ptr), value :: integrator
    end function
    real(c_double) function c_integrator_diverged_at(integrator) bind(c, name="hooke_integrator_diverged_at")
      import
      type(c_ptr), value :: integrator
    end function
    integer(c_int32_t) function c_integrator_on_warning(integrator, warning, ctx) &
      bind(c, name="hooke_integrator_on_warning")
      import
      type(c_ptr), value :: integrator, ctx
      type(c_funptr), value :: warning
    end function
  end interface
end module
