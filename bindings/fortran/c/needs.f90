! Made from include/hooke/needs.h by make_interfaces.py.
module hooke_c_needs
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_needs_options_create(options) bind(c, name="hooke_needs_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_needs_create(system, run, options, needs) bind(c, name="hooke_needs_create")
      import
      type(c_ptr), value :: system, run, options
      type(c_ptr), intent(out) :: needs
    end function
    subroutine c_needs_destroy(needs) bind(c, name="hooke_needs_destroy")
      import
      type(c_ptr), value :: needs
    end subroutine
    subroutine c_needs_on_progress(needs, progress, ctx) bind(c, name="hooke_needs_on_progress")
      import
      type(c_ptr), value :: needs, ctx
      type(c_funptr), value :: progress
    end subroutine
    integer(c_int32_t) function c_needs_find(needs) bind(c, name="hooke_needs_find")
      import
      type(c_ptr), value :: needs
    end function
    integer(c_int32_t) function c_needs_refine(needs) bind(c, name="hooke_needs_refine")
      import
      type(c_ptr), value :: needs
    end function
    real(c_double) function c_needs_figure(needs, what) bind(c, name="hooke_needs_figure")
      import
      type(c_ptr), value :: needs
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_needs_word(needs, what) bind(c, name="hooke_needs_word")
      import
      type(c_ptr), value :: needs
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_needs_row_count(needs) bind(c, name="hooke_needs_row_count")
      import
      type(c_ptr), value :: needs
    end function
    type(c_ptr) function c_needs_text(needs, row, what) bind(c, name="hooke_needs_text")
      import
      type(c_ptr), value :: needs
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_needs_number(needs, row, what) bind(c, name="hooke_needs_number")
      import
      type(c_ptr), value :: needs
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_needs_lean(needs) bind(c, name="hooke_needs_lean")
      import
      type(c_ptr), value :: needs
    end function
    type(c_ptr) function c_needs_lean_run(needs) bind(c, name="hooke_needs_lean_run")
      import
      type(c_ptr), value :: needs
    end function
    integer(c_int64_t) function c_needs_lean_particle(needs, particle) bind(c, name="hooke_needs_lean_particle")
      import
      type(c_ptr), value :: needs
      integer(c_int64_t), value :: particle
    end function
    integer(c_int32_t) function c_needs_lean_position(needs, q, position) bind(c, name="hooke_needs_lean_position")
      import
      type(c_ptr), value :: needs
      real(c_double), intent(in), optional :: q(*)
      real(c_double), intent(inout), optional :: position(*)
    end function
    integer(c_int64_t) function c_needs_part_count(needs) bind(c, name="hooke_needs_part_count")
      import
      type(c_ptr), value :: needs
    end function
    type(c_ptr) function c_needs_part_text(needs, part, what) bind(c, name="hooke_needs_part_text")
      import
      type(c_ptr), value :: needs
      integer(c_int64_t), value :: part
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_needs_part_number(needs, part, what) bind(c, name="hooke_needs_part_number")
      import
      type(c_ptr), value :: needs
      integer(c_int64_t), value :: part
      character(kind=c_char), intent(in), optional :: what(*)
    end function
  end interface
end module
