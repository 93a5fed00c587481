! A force for --force: a tether from the last particle to a point, 20 N/m from 0.3 m of length on.
!   gfortran -O2 -ffp-contract=off -shared -fPIC tether.f90 -o tether.so
!   hooke run rope.json --force ./tether.so
module tether
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_ptr
  implicit none
  ! the ABI number of the hooke that it is for ('hooke --version')
  integer(c_int32_t), bind(c, name="hooke_own_force_abi") :: abi = 1
contains
  function add(n, t, q, v, force, ctx) result(stop_value) bind(c, name="hooke_own_force")
    integer(c_int64_t), value :: n
    real(c_double), value :: t
    real(c_double), intent(in) :: q(3, n), v(3, n)
    real(c_double), intent(inout) :: force(3, n)
    type(c_ptr), value :: ctx
    integer(c_int32_t) :: stop_value ! anything but 0 stops the run
    real(c_double), parameter :: point(3) = [0.5d0, 0.4d0, -0.2d0], stiffness = 20, length = 0.3d0 ! m, N/m, m
    real(c_double) :: d(3), r
    d = q(:, n) - point
    r = sqrt((d(1)*d(1) + d(2)*d(2)) + d(3)*d(3))
    force(:, n) = force(:, n) - (stiffness*(r - length)*(1/r))*d ! N
    stop_value = 0
  end function
end module
