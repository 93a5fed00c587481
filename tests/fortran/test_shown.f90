! Trajectories viewed: as a page, and in ParaView.
program test_shown
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use check
  use hooke
  use scenes
  implicit none
  if (hooke_build_fact("hdf5") == "") then
    call expect(.true., "nothing to show")
  else
    call show()
  end if
  call finish()

contains

  subroutine show()
    type(hooke_record) :: record
    type(hooke_options) :: options
    type(hooke_view) :: view, beside
    logical :: there
    integer :: status, bytes
    call write_oscillator(output("shown.h5"))
    call record%open(output("shown.h5"))
    call record%write_xdmf(output("shown.xdmf"))
    inquire (file=output("shown.xdmf"), exist=there)
    call expect(there, "for ParaView")
    call record%write_xdmf("no/such/folder/shown.xdmf", status)
    call expect(status == hooke_io_failed, "where there is a place for it")
    call options%create("view")
    call view%create(record, options, status)
    if (status == hooke_not_built) return
    call expect(status == hooke_ok .and. nint(view%number("particles")) == 2, "two particles are shown")
    call expect(ieee_is_nan(view%number("no such number")), "and numbers that there are")
    call beside%create(record, options)
    call record%destroy()
    call view%write(output("shown.html"), "an oscillator")
    call expect(view%number("bytes") > 1000, "as a page")
    call view%add(beside)
    call view%write(output("shown.html"))
    inquire (file=output("shown.html"), size=bytes)
    call expect(bytes > view%number("bytes") + beside%number("bytes"), "with another beside it")
  end subroutine
end program
