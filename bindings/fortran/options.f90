! Named options, with their types, units, bounds and defaults.
module hooke_option_tables
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_ptr
  use hooke_base, only: accept, hooke_bad_value, refuse, to_c, to_series, zero_based
  use hooke_c_parts, only: c_mesh_set
  use hooke_c_options
  use hooke_queries_of_options
  implicit none
  private
  public :: hooke_options

  type, extends(hooke_options_queries) :: hooke_options
  contains
    procedure :: copy_to         ! another object with the same values
    procedure, private :: set_real, set_reals, set_whole, set_wholes, set_logical, set_text
    generic :: set => set_real, set_reals, set_whole, set_wholes, set_logical, set_text
    procedure :: set_mesh        ! the surface of a part of the kind "mesh", from arrays; read_mesh() from an OBJ file
    procedure :: numbers         ! all of them
  end type

contains

  subroutine copy_to(self, copy, status)
    class(hooke_options), intent(in) :: self
    type(hooke_options), intent(inout) :: copy
    integer, intent(out), optional :: status
    type(c_ptr) :: options
    integer(c_int32_t) :: code
    if (self%is_missing(status)) return
    code = c_options_copy(self%address(), options)
    if (code == 0) call copy%take(options, c_options_destroy)
    call accept(code, status)
  end subroutine

  subroutine set_real(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    real(c_double), intent(in) :: value
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_options_set_number(self%address(), to_c(name), value), status)
  end subroutine

  subroutine set_reals(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    real(c_double), intent(in), contiguous :: value(:)
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_options_set_numbers(self%address(), to_c(name), size(value, kind=c_int64_t), value), status)
  end subroutine

  subroutine set_whole(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value
    integer, intent(out), optional :: status
    call self%set(name, real(value, c_double), status)
  end subroutine

  subroutine set_wholes(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(in) :: value(:)
    integer, intent(out), optional :: status
    call self%set(name, real(value, c_double), status)
  end subroutine

  subroutine set_logical(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name
    logical, intent(in) :: value
    integer, intent(out), optional :: status
    call self%set(name, merge(1, 0, value), status)
  end subroutine

  subroutine set_text(self, name, value, status)
    class(hooke_options), intent(inout) :: self
    character(*), intent(in) :: name, value
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_options_set_text(self%address(), to_c(name), to_c(value)), status)
  end subroutine

  ! vertices(3, m) [m] and triangles(3, n) of their numbers, from 1.
  subroutine set_mesh(self, vertices, triangles, status)
    class(hooke_options), intent(inout) :: self
    real(c_double), intent(in), contiguous :: vertices(:, :)
    integer, intent(in) :: triangles(:, :)
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    if (size(vertices, 1) /= 3 .or. size(triangles, 1) /= 3) then
      call refuse(hooke_bad_value, "vertices and triangles of a mesh have the shapes (3, m) and (3, n)", status)
      return
    end if
    call accept(c_mesh_set(self%address(), size(vertices, 2, c_int64_t), vertices, size(triangles, 2, c_int64_t), &
      zero_based(triangles)), status)
  end subroutine

  function numbers(self, name) result(values)
    class(hooke_options), intent(in) :: self
    character(*), intent(in) :: name
    real(c_double), allocatable :: values(:)
    real(c_double), pointer, contiguous :: there(:)
    there => to_series(c_options_numbers(self%address(), to_c(name)), &
      int(self%number_count(name), c_int64_t))
    allocate (values(0))
    if (associated(there)) values = there
  end function

end module
