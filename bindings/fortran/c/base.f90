! Made from include/hooke/base.h by make_interfaces.py.
module hooke_c_base
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_ptr
  implicit none

  interface
    type(c_ptr) function c_last_error() bind(c, name="hooke_last_error")
      import
    end function
    type(c_ptr) function c_status_name(status) bind(c, name="hooke_status_name")
      import
      integer(c_int32_t), value :: status
    end function
    type(c_ptr) function c_version() bind(c, name="hooke_version")
      import
    end function
    integer(c_int32_t) function c_abi() bind(c, name="hooke_abi")
      import
    end function
    type(c_ptr) function c_build_fact(what) bind(c, name="hooke_build_fact")
      import
      character(kind=c_char), intent(in), optional :: what(*)
    end function
  end interface
end module
