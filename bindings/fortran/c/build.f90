! Made from include/hooke/build.h by make_interfaces.py.
module hooke_c_build
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int64_t) function c_part_kind_count() bind(c, name="hooke_part_kind_count")
      import
    end function
    type(c_ptr) function c_part_kind(kind) bind(c, name="hooke_part_kind")
      import
      integer(c_int64_t), value :: kind
    end function
    type(c_ptr) function c_part_kind_summary(kind) bind(c, name="hooke_part_kind_summary")
      import
      integer(c_int64_t), value :: kind
    end function
    integer(c_int32_t) function c_part_options_create(kind, options) bind(c, name="hooke_part_options_create")
      import
      character(kind=c_char), intent(in), optional :: kind(*)
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_system_add_part(system, kind, name, options, first, count) &
      bind(c, name="hooke_system_add_part")
      import
      type(c_ptr), value :: system, options
      character(kind=c_char), intent(in), optional :: kind(*), name(*)
      integer(c_int64_t), intent(inout), optional :: first(*), count(*)
    end function
    integer(c_int32_t) function c_mesh_set(options, vertex_count, vertices, triangle_count, triangles) &
      bind(c, name="hooke_mesh_set")
      import
      type(c_ptr), value :: options
      integer(c_int64_t), value :: vertex_count, triangle_count
      real(c_double), intent(in), optional :: vertices(*)
      integer(c_int64_t), intent(in), optional :: triangles(*)
    end function
  end interface
end module
