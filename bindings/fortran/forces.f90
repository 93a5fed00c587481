! Callback forces and motions: types to extend, and their interface to C.
!
! A `stop_value` is initially 0; any other value stops the run and is returned by hooke_integrator's
! stop_value().
module hooke_forces
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int32_t, c_int64_t, c_ptr
  use hooke_c_system, only: c_rows_hold
  use hooke_handles, only: called_object
  implicit none
  private
  public :: hooke_force, hooke_force_with_product, hooke_drive, rows_hold
  public :: call_force, call_product, call_drive

  ! A force on all particles. Called with every q and v that a method tries, never concurrently for one integrator.
  type, abstract :: hooke_force
  contains
    procedure(add_force), deferred :: add
  end type

  ! A force with its derivative, which replaces difference quotients.
  type, abstract, extends(hooke_force) :: hooke_force_with_product
  contains
    procedure(add_force_product), deferred :: add_product
  end type

  ! A prescribed motion of `n` particles: a function of t alone.
  type, abstract :: hooke_drive
  contains
    procedure(move), deferred :: move
  end type

  abstract interface
    ! Adds newtons to `force`.
    subroutine add_force(self, n, t, q, v, force, stop_value)
      import :: c_double, hooke_force
      class(hooke_force), intent(inout) :: self
      integer, intent(in) :: n
      real(c_double), intent(in) :: t, q(3, n), v(3, n)
      real(c_double), intent(inout) :: force(3, n)
      integer, intent(inout) :: stop_value
    end subroutine

    ! Adds (df/dq) dq + (df/dv) dv of that force to `out`.
    subroutine add_force_product(self, n, t, q, v, dq, dv, out, stop_value)
      import :: c_double, hooke_force_with_product
      class(hooke_force_with_product), intent(inout) :: self
      integer, intent(in) :: n
      real(c_double), intent(in) :: t, q(3, n), v(3, n), dq(3, n), dv(3, n)
      real(c_double), intent(inout) :: out(3, n)
      integer, intent(inout) :: stop_value
    end subroutine

    ! Sets position [m] and velocity [m/s] of the driven particles.
    subroutine move(self, n, t, q, v, stop_value)
      import :: c_double, hooke_drive
      class(hooke_drive), intent(inout) :: self
      integer, intent(in) :: n
      real(c_double), intent(in) :: t
      real(c_double), intent(out) :: q(3, n), v(3, n)
      integer, intent(inout) :: stop_value
    end subroutine
  end interface

contains

  ! Holds the arrays of a force by its `q` beyond the call (`more` 1), or releases them (-1); how often they are held.
  integer function rows_hold(q, more)
    real(c_double), intent(in), contiguous :: q(:, :)
    integer, intent(in) :: more
    rows_hold = int(c_rows_hold(q, int(more, c_int32_t)))
  end function

  integer(c_int32_t) function call_force(n, t, q, v, force, ctx) bind(c, name="")
    integer(c_int64_t), value :: n
    real(c_double), value :: t
    real(c_double), intent(in) :: q(3, n), v(3, n)
    real(c_double), intent(inout) :: force(3, n)
    type(c_ptr), value :: ctx
    type(called_object), pointer :: called
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    select type (it => called%it)
    class is (hooke_force)
      call it%add(int(n), t, q, v, force, stop_value)
    end select
    call_force = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_product(n, t, q, v, dq, dv, out, ctx) bind(c, name="")
    integer(c_int64_t), value :: n
    real(c_double), value :: t
    real(c_double), intent(in) :: q(3, n), v(3, n), dq(3, n), dv(3, n)
    real(c_double), intent(inout) :: out(3, n)
    type(c_ptr), value :: ctx
    type(called_object), pointer :: called
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    select type (it => called%it)
    class is (hooke_force_with_product)
      call it%add_product(int(n), t, q, v, dq, dv, out, stop_value)
    end select
    call_product = int(stop_value, c_int32_t)
  end function

  integer(c_int32_t) function call_drive(n, t, q, v, ctx) bind(c, name="")
    integer(c_int64_t), value :: n
    real(c_double), value :: t
    real(c_double), intent(out) :: q(3, n), v(3, n)
    type(c_ptr), value :: ctx
    type(called_object), pointer :: called
    integer :: stop_value
    call c_f_pointer(ctx, called)
    stop_value = 0
    select type (it => called%it)
    class is (hooke_drive)
      call it%move(int(n), t, q, v, stop_value)
    end select
    call_drive = int(stop_value, c_int32_t)
  end function
end module
