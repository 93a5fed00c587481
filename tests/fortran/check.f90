! Shared parts of the tests: expectations, which are counted, and equality of bits.
module check
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t, c_null_char
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  private
  public :: expect, expect_near, expect_text, finish, same, same_count, output, twin_rope, twin_status, twin_version

  integer, save :: failures = 0, expectations = 0

  interface
    ! The final state of a rope of 8 segments that C runs; the statuses by their names in C, and whether a version is that of C.
    integer(c_int32_t) function twin_rope(method, q, v) bind(c)
      import
      character(kind=c_char), intent(in) :: method(*)
      real(c_double), intent(inout) :: q(*), v(*)
    end function
    integer(c_int32_t) function twin_status(place) bind(c)
      import
      integer(c_int32_t), value :: place
    end function
    integer(c_int32_t) function twin_version(text) bind(c)
      import
      character(kind=c_char), intent(in) :: text(*)
    end function
  end interface

contains

  subroutine expect(fine, what)
    logical, intent(in) :: fine
    character(*), intent(in) :: what
    expectations = expectations + 1
    if (fine) return
    failures = failures + 1
    write (error_unit, "(2a)") "not so: ", what
  end subroutine

  subroutine expect_near(found, wanted, tolerance, what)
    real(c_double), intent(in) :: found, wanted, tolerance
    character(*), intent(in) :: what
    character(60) :: numbers
    write (numbers, "(es24.16, a, es24.16)") found, " and not ", wanted
    call expect(abs(found - wanted) <= tolerance, what // ":" // numbers)
  end subroutine

  ! `found` contains `part`.
  subroutine expect_text(found, part, what)
    character(*), intent(in) :: found, part, what
    call expect(index(found, part) > 0, what // ": """ // part // """ in """ // found // """")
  end subroutine

  subroutine finish()
    if (failures > 0) error stop "expectations failed"
    if (expectations == 0) error stop "nothing was expected"
    write (*, "(i0, a)") expectations, " expectations hold"
  end subroutine

  elemental logical function same(a, b)
    real(c_double), intent(in) :: a, b
    same = transfer(a, 0_c_int64_t) == transfer(b, 0_c_int64_t)
  end function

  ! Number of equal elements of two lists, to the bit.
  integer function same_count(a, b)
    real(c_double), intent(in) :: a(:), b(:)
    same_count = count(same(a, b))
  end function

  ! A file to write, in a folder of this test.
  function output(name) result(path)
    character(*), intent(in) :: name
    character(:), allocatable :: path
    character(1000) :: folder
    call get_environment_variable("HOOKE_TEST_OUTPUT", folder)
    path = trim(folder) // "/" // name
  end function
end module
