! Made from include/hooke/options.h by make_interfaces.py.
module hooke_c_options
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_options_create(name, options) bind(c, name="hooke_options_create")
      import
      character(kind=c_char), intent(in), optional :: name(*)
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_options_copy(options, copy) bind(c, name="hooke_options_copy")
      import
      type(c_ptr), value :: options
      type(c_ptr), intent(out) :: copy
    end function
    subroutine c_options_destroy(options) bind(c, name="hooke_options_destroy")
      import
      type(c_ptr), value :: options
    end subroutine
    integer(c_int32_t) function c_options_set_number(options, name, value) bind(c, name="hooke_options_set_number")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*)
      real(c_double), value :: value
    end function
    integer(c_int32_t) function c_options_set_numbers(options, name, count, values) &
      bind(c, name="hooke_options_set_numbers")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*)
      integer(c_int64_t), value :: count
      real(c_double), intent(in), optional :: values(*)
    end function
    integer(c_int32_t) function c_options_set_text(options, name, text) bind(c, name="hooke_options_set_text")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*), text(*)
    end function
    integer(c_int32_t) function c_options_unset(options, name) bind(c, name="hooke_options_unset")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    integer(c_int32_t) function c_options_is_set(options, name) bind(c, name="hooke_options_is_set")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    integer(c_int64_t) function c_options_number_count(options, name) bind(c, name="hooke_options_number_count")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    type(c_ptr) function c_options_numbers(options, name) bind(c, name="hooke_options_numbers")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    real(c_double) function c_options_number(options, name) bind(c, name="hooke_options_number")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    type(c_ptr) function c_options_text(options, name) bind(c, name="hooke_options_text")
      import
      type(c_ptr), value :: options
      character(kind=c_char), intent(in), optional :: name(*)
    end function
    integer(c_int64_t) function c_options_row_count(options) bind(c, name="hooke_options_row_count")
      import
      type(c_ptr), value :: options
    end function
    type(c_ptr) function c_options_row(options, row, property) bind(c, name="hooke_options_row")
      import
      type(c_ptr), value :: options
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: property(*)
    end function
    real(c_double) function c_options_row_number(options, row, property) bind(c, name="hooke_options_row_number")
      import
      type(c_ptr), value :: options
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: property(*)
    end function
  end interface
end module
