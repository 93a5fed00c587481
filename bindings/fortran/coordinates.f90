! Forces on generalized coordinates, q'' = W f(t, q, v): types to extend, and their interface to C.
!
! A `stop_value` is initially 0; any other value stops the run and is returned by hooke_integrator's
! stop_value().
module hooke_coordinates
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int32_t, c_int64_t, c_ptr
  use hooke_handles, only: called_object
  implicit none
  private
  public :: hooke_coordinate_force, hooke_coordinate_force_with_product
  public :: call_coordinate_force, call_coordinate_product

  ! Called with every q and v that a method tries, never concurrently for one integrator.
  type, abstract :: hooke_coordinate_force
  contains
    procedure(add_force), deferred :: add
  end type

  ! A force with its derivative, which replaces difference quotients.
  type, abstract, extends(hooke_coordinate_force) :: hooke_coordinate_force_with_product
  contains
    procedure(add_force_product), deferred :: add_product
  end type

  abstract interface
    ! Adds f to `force`, which is zero.
    subroutine add_force(self, n, t, q, v, force, stop_value)
      import :: c_double, hooke_coordinate_force
      class(hooke_coordinate_force), intent(inout) :: self
      integer, intent(in) :: n
      real(c_double), intent(in) :: t, q(n), v(n)
      real(c_double), intent(inout) :: force(n)
      integer, intent(inout) :: stop_value
    end subroutine

    ! Adds (df/dq) dq + (df/dv) dv to `out`, which is zero.
    subroutine add_force_product(self, n, t, q, v, dq, dv, out, stop_value)
      import :: c_double, hooke_coordinate_force_with_product
      class(hooke_coordinate_force_with_product), intent(inout) :: self
      integer, intent(in) :: n
      real(c_double), intent(in) :: t, q(n), v(n), dq(n), dv(n)
      real(c_double), intent(inout) :: out(n)
      integer, intent(inout) :: stop_value
    end subroutine
  end interface

contains

  integer(c_int32_t) function call_coordinate_force(n, t, q, v, force, ctx) bind(c, name="")
    integer(c_int64_t), value :: n
    real(c_double), value :: t
    real(c_double), intent(in) :: q(n), v(n)
    real(c_double), intent(inout) :: force(n)
    type(c_ptr), value :: ctx
    type(called_object), pointer :: called
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    select type (it => called%it)
    class is (hooke_coordinate_force)
      call it%add(int(n), t, q, v, force, stop_value)
    end select
    call_coordinate_force = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_coordinate_product(n, t, q, v, dq, dv, out, ctx) bind(c, name="")
    integer(c_int64_t), value :: n
    real(c_double), value :: t
    real(c_double), intent(in) :: q(n), v(n), dq(n), dv(n)
    real(c_double), intent(inout) :: out(n)
    type(c_ptr), value :: ctx
    type(called_object), pointer :: called
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    select type (it => called%it)
    class is (hooke_coordinate_force_with_product)
      call it%add_product(int(n), t, q, v, dq, dv, out, stop_value)
    end select
    call_coordinate_product = int(stop_value, c_int32_t)
  end function
end module
