! Made from include/hooke/checkpoint.h by make_interfaces.py.
module hooke_c_checkpoint
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_checkpoint_write(path, integrator, state, run) bind(c, name="hooke_checkpoint_write")
      import
      character(kind=c_char), intent(in), optional :: path(*), run(*)
      type(c_ptr), value :: integrator, state
    end function
    integer(c_int32_t) function c_checkpoint_read(path, run, integrator, state) bind(c, name="hooke_checkpoint_read")
      import
      character(kind=c_char), intent(in), optional :: path(*), run(*)
      type(c_ptr), value :: integrator, state
    end function
    integer(c_int32_t) function c_trajectory_checkpoint(trajectory, integrator, state) &
      bind(c, name="hooke_trajectory_checkpoint")
      import
      type(c_ptr), value :: trajectory, integrator, state
    end function
    integer(c_int32_t) function c_trajectory_resume(path, system, integrator, state, trajectory) &
      bind(c, name="hooke_trajectory_resume")
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), value :: system, integrator, state
      type(c_ptr), intent(out) :: trajectory
    end function
    type(c_ptr) function c_trajectory_origin(trajectory) bind(c, name="hooke_trajectory_origin")
      import
      type(c_ptr), value :: trajectory
    end function
  end interface
end module
