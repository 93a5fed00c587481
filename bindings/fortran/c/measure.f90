! Made from include/hooke/measure.h by make_interfaces.py.
module hooke_c_measure
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_ptr
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
  end interface
end module
