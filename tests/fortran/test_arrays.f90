! Whole arrays of a trajectory file.
program test_arrays
  use check
  use hooke
  use scenes
  implicit none
  if (hooke_build_fact("hdf5") == "") then
    call expect(.true., "no files")
  else
    call look()
  end if
  call finish()

contains

  subroutine look()
    type(hooke_record) :: record
    real(hooke_real), allocatable :: values(:, :)
    integer :: status
    call write_oscillator(output("arrays.h5"))
    call record%open(output("arrays.h5"))
    call record%numbers("springs", values)
    call expect(all(shape(values) == [2, 1]) .and. all(nint(values(:, 1)) == [1, 2]), "ends count from 1")
    call record%numbers("mass", values)
    call expect(size(values) == 2 .and. same(values(1, 2), 0.5_hooke_real), "masses")
    call record%numbers("species", values)
    call expect(all(nint(values(1, :)) == [1, 0]), "the first is held")
    call record%numbers("no such array", values, status)
    call expect(status == hooke_bad_value .and. size(values) == 0, "no such array")
    call expect(record%place("position") > 0 .and. record%place("no such array") == -1, "where it is in the file")
  end subroutine
end program
