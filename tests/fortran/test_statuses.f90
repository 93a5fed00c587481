! Statuses and messages; with the argument "stop", an error without a status.
program test_statuses
  use check
  use hooke
  use scenes
  implicit none
  integer, parameter :: all(12) = [hooke_ok, hooke_stopped, hooke_diverged, hooke_step_limit, hooke_no_memory, &
    hooke_bad_value, hooke_bad_call, hooke_io_failed, hooke_not_built, hooke_unsuited, hooke_solver_failed, hooke_internal]
  character(10) :: argument
  integer :: k

  call get_command_argument(1, argument)
  if (argument == "stop") call stop_here()
  if (argument == "shape") call stop_at_shape()
  do k = 1, size(all)
    call expect(all(k) == twin_status(k), hooke_status_name(all(k)) // " has the number of C")
  end do
  call expect(hooke_status_name(hooke_bad_value) == "bad value", "names of statuses")
  call expect(twin_version(hooke_version() // char(0)) == 1 .and. hooke_abi() == 1, "version " // hooke_version())
  call expect(hooke_build_fact("instructions") /= "", "facts about the build")
  call expect(hooke_build_fact("no such fact") == "", "and what is none")
  call expect(hooke_part_kind(2, "name") /= "" .and. hooke_part_kind(1, "name") == "rope", "kinds of parts")
  call refusals()
  call options()
  call finish()

contains

  subroutine stop_here()
    type(hooke_options) :: run
    call run%create("run")
    call run%set("step", -1)
  end subroutine

  subroutine stop_at_shape()
    type(hooke_system) :: system
    real(hooke_real) :: q(3, 5)
    call make_oscillator(system)
    q = 0
    print *, system%energy("springs", q)
  end subroutine

  subroutine refusals()
    type(hooke_system) :: system, none
    type(hooke_options) :: spring, anchor, nothing
    real(hooke_real) :: position(3, 2), flat(2, 2), f(3, 2)
    integer :: status, first
    position = 0
    position(1, 2) = 1
    flat = 0
    call none%commit(status)
    call expect(status == hooke_bad_call, "a system that was not created")
    call expect_text(hooke_message(), "not created", "is said to be none")
    call system%create()
    call system%add_particles(flat, 1.0_hooke_real, first=first, status=status)
    call expect(status == hooke_bad_value .and. first == 0, "rows of two are no positions")
    call expect_text(hooke_message(), "(3, n)", "and the shape is said")
    call system%add_particles(position, [1, 2, 3]*1.0_hooke_real, status=status)
    call expect(status == hooke_bad_value, "three masses for two particles")
    call expect(index(hooke_message(), "(3, n)") == 0, "is told by the library: " // hooke_message())
    call system%add_particles(position, 1.0_hooke_real, position, first, status)
    call expect(status == hooke_ok .and. first == 1, "with velocities")
    call system%add_particles(position + 1, 1.0_hooke_real, first=first)
    call expect(first == 3, "the next ones are 3 and 4")
    call system%pin(5, status)
    call expect(status == hooke_bad_value, "there is no particle 5")
    call expect_text(hooke_message(), "4", "which is 4 in messages")
    call system%pin(0, status)
    call expect(status == hooke_bad_value, "nor a particle 0")
    call system%add_springs(reshape([1, 2], [2, 1]), nothing, status=status)
    call expect(status == hooke_bad_call, "options that were not created")
    call spring%create("springs")
    call spring%set("stiffness", 10)
    call system%add_springs(reshape([1, 2, 3], [3, 1]), spring, status=status)
    call expect(status == hooke_bad_value, "a spring has two ends")
    call system%add_springs(reshape([1, 1], [2, 1]), spring, status=status)
    call expect(status == hooke_bad_value, "that differ")
    call system%add_bending(reshape([1, 2], [2, 1]), 1.0_hooke_real, status=status)
    call expect(status == hooke_bad_value, "a triple has three")
    call system%add_bending(reshape([1, 2, 3], [3, 1]), [1.0_hooke_real], "fold", status)
    call expect(status == hooke_ok, "as here")
    call anchor%create("anchors")
    call anchor%set("stiffness", 1)
    call system%add_anchors([1, 5], anchor, status=status)
    call expect(status == hooke_bad_value .and. index(hooke_message(), "particles[1]") > 0, "an anchor of no particle")
    call system%add_anchors([1, 2], anchor, "held", status)
    call expect(status == hooke_ok .and. system%group_name("anchors", 1) == "held", "two anchors")
    call system%force(0.0_hooke_real, position, position, f, status)
    call expect(status == hooke_bad_value, "arrays for two particles of four")
    call system%set_drag(-1.0_hooke_real, status)
    call expect(status == hooke_bad_value, "negative drag")
    call system%commit()
    call system%commit(status)
    call expect(status == hooke_bad_call, "committed twice")
  end subroutine

  subroutine options()
    type(hooke_options) :: cloth, copy, rope
    integer :: status, row, rows
    call cloth%create("no such part", status)
    call expect(status == hooke_bad_value .and. .not. cloth%exists(), "no options of it")
    call cloth%create("cloth  ")
    call cloth%set("size", [3, 4])
    call cloth%set("origin", [1, 2, 3]*0.5_hooke_real)
    call cloth%set("structural", "")
    call cloth%set("structural.compression", .false.)
    call cloth%set("mass", "0.25")
    call cloth%set("mas", 1, status)
    call expect(status == hooke_bad_value, "a name that is none")
    call expect_text(hooke_message(), "mass", "and one that it might be")
    call cloth%set("mass", -1, status)
    call expect(status == hooke_bad_value .and. same(cloth%number("mass"), 0.25_hooke_real), "the old value stays")
    call expect(size(cloth%numbers("origin")) == 3 .and. cloth%number_count("size") == 2, "lists")
    call expect(same_count(cloth%numbers("origin"), [1, 2, 3]*0.5_hooke_real) == 3, "of these numbers")
    call expect(size(cloth%numbers("shear.stiffness")) == 0, "and of none")
    call cloth%copy_to(copy)
    call cloth%unset("mass")
    call expect(.not. cloth%is_set("mass") .and. copy%is_set("mass"), "a copy is another object")
    rows = 0
    do row = 1, cloth%row_count()
      if (cloth%row(row, "name") == "structural.stiffness" .and. cloth%row(row, "unit") == "N") rows = rows + 1
    end do
    call expect(rows == 1 .and. cloth%row(0, "name") == "", "the table")
    rope = cloth
    call rope%unset("no such option", status)
    call expect(status == hooke_bad_value, "no such option")
  end subroutine
end program
