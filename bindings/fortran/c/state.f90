! Made from include/hooke/state.h by make_interfaces.py.
module hooke_c_state
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_state_create(system, state) bind(c, name="hooke_state_create")
      import
      type(c_ptr), value :: system
      type(c_ptr), intent(out) :: state
    end function
    integer(c_int32_t) function c_state_create_first_order(size, state) bind(c, name="hooke_state_create_first_order")
      import
      integer(c_int64_t), value :: size
      type(c_ptr), intent(out) :: state
    end function
    subroutine c_state_destroy(state) bind(c, name="hooke_state_destroy")
      import
      type(c_ptr), value :: state
    end subroutine
    integer(c_int32_t) function c_state_copy(from, to) bind(c, name="hooke_state_copy")
      import
      type(c_ptr), value :: from, to
    end function
    real(c_double) function c_state_time(state) bind(c, name="hooke_state_time")
      import
      type(c_ptr), value :: state
    end function
    subroutine c_state_set_time(state, t) bind(c, name="hooke_state_set_time")
      import
      type(c_ptr), value :: state
      real(c_double), value :: t
    end subroutine
    integer(c_int64_t) function c_state_size(state) bind(c, name="hooke_state_size")
      import
      type(c_ptr), value :: state
    end function
    type(c_ptr) function c_state_position(state) bind(c, name="hooke_state_position")
      import
      type(c_ptr), value :: state
    end function
    type(c_ptr) function c_state_velocity(state) bind(c, name="hooke_state_velocity")
      import
      type(c_ptr), value :: state
    end function
  end interface
end module
