! Bounds, estimates, comparisons, studies, limits, costs, needs and causes, on scenes with known results.
module appraisers
  use hooke
  implicit none

  type, extends(hooke_observer) :: appraiser
    type(hooke_estimate) :: estimate
  contains
    procedure :: see => appraise
  end type

contains

  subroutine appraise(self, step, state, stop_value)
    class(appraiser), intent(inout) :: self
    integer(hooke_long), intent(in) :: step
    type(hooke_state), intent(in) :: state
    integer, intent(inout) :: stop_value
    call self%estimate%see(step, state)
    stop_value = 0
  end subroutine
end module

program test_measures
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
  use appraisers
  use check
  use hooke
  use parts
  use scenes
  implicit none
  real(hooke_real), parameter :: omega = sqrt(40.0_hooke_real) ! of the oscillator

  if (hooke_build_fact("gsl") == "" .or. hooke_build_fact("sundials") == "") then
    call without_libraries()
  else
    call limits()
    call comparisons()
    call causes()
    call needs()
  end if
  call studies()
  call costs()
  call estimates()
  call finish()

contains

  subroutine without_libraries()
    type(hooke_system) :: system
    type(hooke_measurement) :: limit
    integer :: status
    call make_oscillator(system)
    call limit%create("limit", system, status=status)
    call expect(status == hooke_not_built .and. .not. limit%exists(), "no limits without a library for eigenvalues")
  end subroutine

  subroutine limits()
    type(hooke_system) :: system
    type(hooke_options) :: options
    type(hooke_state) :: state
    type(hooke_measurement) :: limit, again
    type(teller), target :: progress
    real(hooke_real) :: bound
    real(hooke_real), allocatable :: bounds(:)
    real(hooke_real), pointer :: shape(:, :)
    integer :: status
    call make_oscillator(system)
    call state%create(system)
    call system%step_bound("symplectic-euler", state%q, bound)
    call expect(bound > 0 .and. bound <= 2/omega*1.000001_hooke_real, "the bound is safe")
    call system%step_bounds(state%q, bounds)
    call expect(any(abs(bounds - bound) <= 0), "all bounds at once")
    call system%step_bound("no such method", state%q, bound, status)
    call expect(status == hooke_bad_value, "of methods that there are")
    call expect_near(hooke_limit_of_mode("verlet", omega, 0.0_hooke_real), 2/omega, 1e-12_hooke_real, "2/omega")
    call options%create("limit")
    call options%set("methods", "forward-euler,symplectic-euler")
    call limit%create("limit", system, options=options)
    call expect(.not. associated(limit%series("limit", 1, "shape")), "no mode before it was found")
    call expect(hooke_measurement_table("limit", 2, "name") == "rows" .and. &
      hooke_measurement_table("limit", 7, "name") == "claims" .and. &
      hooke_measurement_table("limit", 8, "name") == "", "tables")
    call expect(hooke_measurement_column("limit", "rows", 3, "name") == "predicted" .and. &
      hooke_measurement_column("limit", "rows", 3, "unit") == "s", "columns")
    call limit%on_progress(progress)
    call limit%run(state)
    again = limit
    call expect(again%row_count("rows") == 2 .and. again%text("rows", 2, "method") == "symplectic-euler", &
      "a row for each")
    call expect_near(again%number("rows", 2, "predicted"), 2/omega, 1e-9_hooke_real, "predicted")
    call expect(abs(again%number("rows", 2, "ratio") - 1) < 0.01_hooke_real, "measured")
    call expect(progress%told > 0 .and. progress%done >= 0, "progress was told")
    call expect_near(again%number("limit", 1, "frequency_max"), omega, 1e-9_hooke_real, "the largest frequency")
    call expect(again%row_count("blame") == 1 .and. again%text("blame", 1, "group") == "spring", "one spring to blame")
    call expect(nint(again%number("blame", 1, "number")) == 1 .and. nint(again%number("blame", 1, "first")) == 1 &
      .and. nint(again%number("blame", 1, "second")) == 2, "numbers count from 1")
    call expect_near(again%number("blame", 1, "share"), 1.0_hooke_real, 1e-12_hooke_real, "and shares do not")
    call expect(again%row_count("participation") == 1 .and. nint(again%number("participation", 1, "particle")) == 2, &
      "particle 2 moves")
    call expect_near(again%number("participation", 1, "mass"), 0.5_hooke_real, 1e-12_hooke_real, "of half a kilogram")
    call expect(again%row_count("modes") >= 1 .and. abs(again%number("modes", 1, "frequency") - omega) < 1e-9_hooke_real, &
      "modes")
    shape(1:3, 1:2) => again%series("limit", 1, "shape")
    call expect(size(again%series("limit", 1, "shape")) == 6, "the mode has as many numbers as positions")
    call expect_near(abs(shape(1, 2)), 1.0_hooke_real, 1e-12_hooke_real, "along the spring")
    call expect(again%text("changes", 1, "kind") == "" .or. again%number("changes", 1, "factor") > 0, "a remedy, or none")
    call limit%label("title", "oscillator")
    call limit%write(output("limit.html"), status)
    call expect(status == merge(hooke_not_built, hooke_ok, hooke_build_fact("chartjs") == ""), "as a page")
    call along(system)
  end subroutine

  subroutine along(system)
    type(hooke_system), intent(in) :: system
    type(hooke_options) :: run, options
    type(hooke_measurement) :: limit
    type(hooke_state) :: state
    call options%create("limit")
    call options%set("along", .true.)
    call make_run(run, "symplectic-euler", 1e-2_hooke_real, 0.5_hooke_real)
    call limit%create("limit", system, run, options)
    call state%create(system)
    call limit%run(state)
    call expect_near(state%time(), 0.5_hooke_real, 1e-12_hooke_real, "the run was made")
    call expect(limit%number("rows", 2, "smallest") <= 2/omega*1.0001_hooke_real, "the smallest limit along it")
  end subroutine

  subroutine estimates()
    type(hooke_system) :: system
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    type(appraiser), target :: watch
    integer :: status
    call make_oscillator(system)
    call make_run(run, "verlet", 1e-3_hooke_real, 0.5_hooke_real)
    call watch%estimate%create(system, -1.0_hooke_real, status)
    call expect(status == hooke_bad_value .and. .not. watch%estimate%exists(), "no negative error")
    call watch%estimate%create(system, ieee_value(1.0_hooke_real, ieee_quiet_nan), watch="1.x,kinetic")
    call integrator%create(system, run)
    call watch%estimate%follow(integrator)
    call state%create(system)
    call integrator%on_frame(watch)
    call watch%estimate%begin(integrator, state)
    call integrator%run(state)
    call watch%estimate%measure(integrator, state)
    call expect(watch%estimate%number("estimate") > 0 .and. watch%estimate%number("estimate") < 1e-3_hooke_real, &
      "the error of a run")
    call expect(watch%estimate%watched(1, "minimum") < watch%estimate%watched(1, "maximum") .and. &
      watch%estimate%watched(2, "from") < 0.25_hooke_real, "extremes of what is watched")
    call expect(watch%estimate%text("by") == "half-step" .and. ieee_is_nan(watch%estimate%number("met")), "by its order")
    if (hooke_build_fact("sundials") == "") return
    call watch%estimate%create(system, 1e-5_hooke_real)
    call watch%estimate%pick(run, "rk4")
    call expect(run%text("method") == "rk4" .and. run%number("step") > 2e-3_hooke_real, "a step for a wanted error")
    call run%destroy()
    call watch%estimate%pick(run, status=status)
    call expect(status == hooke_bad_call, "options that are gone")
  end subroutine

  subroutine comparisons()
    type(hooke_system) :: system
    type(hooke_options) :: run, options
    type(hooke_measurement) :: comparison
    type(teller), target :: progress
    real(hooke_real), pointer :: time(:)
    integer :: status
    call make_oscillator(system)
    call make_run(run, "rk4", 1e-2_hooke_real, 0.5_hooke_real)
    call options%create("study")
    call options%set("once", .true.)
    call options%set("methods", "no such method")
    call comparison%create("study", system, run, options, status)
    call expect(status == hooke_bad_value, "a method that is none")
    call options%set("methods", "rk4,forward-euler")
    call comparison%create("study", system, run, options)
    call comparison%on_progress(progress)
    call comparison%run()
    call expect(comparison%row_count("rows") == 2 .and. comparison%text("rows", 1, "method") == "rk4", "rows")
    call expect(comparison%number("rows", 1, "error") < 1e-4_hooke_real*comparison%number("rows", 2, "error"), &
      "rk4 is better")
    call expect_text(comparison%text("reference", 1, "method"), "cvode", "the reference")
    time => comparison%series("reference", 1, "time")
    call expect(size(time) == nint(comparison%number("study", 1, "frames")) .and. &
      abs(time(size(time)) - 0.5_hooke_real) < 1e-12, "series")
    call expect(.not. associated(comparison%series("rows", 2, "nothing")), "of words that there are")
    call expect(progress%told > 0, "progress was told")
    progress%stop_after = progress%told + 1
    call comparison%create("study", system, run, options)
    call comparison%on_progress(progress)
    call comparison%run(status=status)
    call expect(status == hooke_stopped, "and can stop it")
    call comparison%on_progress()
  end subroutine

  subroutine studies()
    type(hooke_system) :: system
    type(hooke_options) :: run, options
    type(hooke_measurement) :: study
    type(teller), target :: progress
    real(hooke_real) :: order
    call make_oscillator(system)
    call make_run(run, "verlet", 1e-2_hooke_real, 0.5_hooke_real)
    call options%create("study")
    call options%set("methods", "symplectic-euler,verlet")
    call options%set("points", 6)
    call study%create("study", system, run, options)
    call study%on_progress(progress)
    call study%run()
    call expect(study%row_count("rows") == 12 .and. study%text("rows", 1, "method") == "symplectic-euler", "six rows a method")
    order = study%number("orders", study%find("orders", "method", "verlet"), "order")
    call expect(order > 1.95_hooke_real .and. order < 2.05_hooke_real, "the order of verlet")
    call expect_near(study%number("orders", 1, "theory"), 1.0_hooke_real, 0.0_hooke_real, &
      "and that of the other in theory")
    call expect(study%text("orders", 2, "note") == "", "nothing in its way")
    call expect(index(study%describe(), study%text("claims", 1, "text") // new_line("a") // study%text("claims", 2, "text")) == 1, &
      "what it says, a line each")
    call expect(study%number("reference", 1, "agreement") > 0 .and. &
      study%number("reference", 1, "agreement") < 1e-8_hooke_real, "the reference agrees")
    call expect((study%text("reference", 1, "method") == study%text("reference", 1, "check")) .eqv. &
      hooke_build_fact("sundials") == "", "by two methods, or by rk4 in two steps")
    call study%recommend(1e-3_hooke_real)
    call expect(study%text("recommendation", 1, "method") /= "" .and. &
      study%text("recommendation", 1, "note") == "", "recommended")
    call expect(study%number("recommendation", 1, "error") <= 1e-3_hooke_real, "what meets the want")
    call expect(size(study%series("rows", 1, "error_at")) == nint(study%number("study", 1, "frames")), "series")
    call expect(study%number("rows", 1, "error") > study%number("rows", 6, "error"), "smaller steps are better")
    call expect(progress%told > 0, "progress was told")
    call expect(hooke_measurement_table(table=1, what="name") /= "", "kinds have names")
    call expect_text(hooke_measurement_table("study", 1, "name"), "study", "and tables")
    call expect_text(hooke_measurement_column("study", "rows", 1, "name"), "method", "with columns")
    call expect(hooke_measurement_column("study", "rows", 99, "name") == "", "so many")
    call write_study(study)
  end subroutine

  subroutine write_study(study)
    type(hooke_measurement), intent(inout) :: study
    integer :: status, unit
    character(200) :: line
    call study%write(output("study.csv"))
    open (newunit=unit, file=output("study.csv"), action="read")
    read (unit, "(a)") line
    close (unit)
    call expect_text(line, "method,", "the table as CSV")
    call study%write(output("study.h5"), status)
    call expect(status == merge(hooke_not_built, hooke_ok, hooke_build_fact("hdf5") == ""), "as HDF5")
    call study%label("title", "an oscillator")
    call study%write(output("study.html"), status)
    call expect(status == merge(hooke_not_built, hooke_ok, hooke_build_fact("chartjs") == ""), "as a page")
    call study%write("no/such/folder/study.csv", status)
    call expect(status == hooke_io_failed, "where there is a place for it")
  end subroutine

  subroutine causes()
    type(hooke_system) :: system
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state, first
    type(hooke_measurement) :: why, kept
    integer :: status
    call make_oscillator(system)
    call make_run(run, "symplectic-euler", 0.4_hooke_real, 40.0_hooke_real)
    call integrator%create(system, run)
    call state%create(system)
    call first%create(system)
    call why%create_why(integrator, status=status)
    call expect(status == hooke_bad_call, "nothing to explain yet")
    call integrator%run(state, status)
    call expect(status == hooke_diverged, "it blew up")
    call why%create_why(integrator)
    call why%run()
    call expect(why%text("why", 1, "cause") == "step-above-limit" .and. &
      len(why%text("why", 1, "sentence")) > 20, why%text("why", 1, "sentence"))
    call expect_near(why%number("why", 1, "step"), 0.4_hooke_real, 1e-12_hooke_real, "of the step")
    call expect(nint(why%number("why", 1, "particle")) == 2, "particle 2")
    call expect(why%row_count("blame") >= 1 .and. nint(why%number("blame", 1, "second")) == 2, "its spring")
    call expect(why%text("blame", 1, "group") == "spring", "by name")
    call expect(why%row_count("advice") >= 1 .and. why%text("advice", 1, "change") /= "", "and what to do")
    call why%advice_apply(1, run)
    call integrator%create(system, run)
    call state%create(system)
    call integrator%run(state, status)
    call expect(status == hooke_ok, "which helps")
    call make_run(run, "symplectic-euler", 0.4_hooke_real, 40.0_hooke_real)
    call kept%create_why_kept(system, run, first, first)
    call kept%run()
    call expect(kept%text("why", 1, "cause") == why%text("why", 1, "cause"), "the same from states that were kept")
  end subroutine

  subroutine costs()
    type(hooke_system) :: system
    type(hooke_options) :: options
    type(hooke_state) :: state
    type(hooke_measurement) :: cost
    integer :: row, found
    call make_cloth(system)
    call state%create(system)
    call options%create("cost")
    call options%set("budget", 0.5_hooke_real)
    call cost%create("cost", system, options=options)
    call cost%run(state)
    call expect(cost%text("cost", 1, "method") == "symplectic-euler" .and. &
      cost%number("cost", 1, "memory_bytes") > 0, "the whole scene")
    found = 0
    do row = 1, cost%row_count("rows")
      if (cost%text("rows", row, "ingredient") == "cloth.shear") found = row
    end do
    call expect(found > 0, "a row for shear")
    if (found > 0) call expect(nint(cost%number("rows", found, "springs")) == 32 .and. &
      nint(cost%number("rows", found, "group")) == 2, &
      "its springs, and its number from 1")
  end subroutine

  subroutine needs()
    type(hooke_system) :: system
    type(hooke_options) :: run, options
    type(hooke_measurement) :: needed, finer
    type(hooke_system) :: lean
    type(hooke_options) :: lean_run
    type(hooke_state) :: state
    type(teller), target :: progress
    real(hooke_real) :: position(3, 25)
    integer :: row, status
    call make_cloth(system)
    call make_run(run, "rk4", 2e-3_hooke_real, 0.1_hooke_real)
    call options%create("needs")
    call options%set("want", 0.02_hooke_real)
    call needed%create("needs", system, run, options)
    call needed%on_progress(progress)
    call needed%lean(lean, status)
    call expect(status == hooke_bad_call .and. .not. lean%exists(), "no lean system before it was found")
    call needed%lean_position(position, position, status)
    call expect(status == hooke_bad_call, "nor positions")
    call needed%recommend(0.1_hooke_real, status)
    call expect(status == hooke_bad_call, "nor what a study has")
    call needed%run()
    call expect(needed%row_count("rows") > 3 .and. progress%told > 0, "a row for each ingredient")
    do row = 1, needed%row_count("rows")
      if (needed%text("rows", row, "kind") == "gravity") exit
    end do
    call expect(nint(needed%number("rows", row, "needed")) == 1, "gravity is needed")
    call expect(needed%text("needs", 1, "method") /= "" .and. needed%number("needs", 1, "runs") > 3, "figures")
    call needed%lean(lean)
    call needed%lean_run(lean_run)
    call expect(lean%exists() .and. lean_run%number("duration") > 0.09_hooke_real, "and a lean system")
    call state%create(lean)
    position = 0
    call needed%lean_position(state%q, position, status)
    call expect(status == hooke_ok .and. maxval(abs(position(:, 25) - [1, 0, 1])) < 0.3_hooke_real, &
      "with its positions")
    call expect(needed%lean_particle(1) >= 0 .and. needed%lean_particle(1) <= 25, "and numbers")
    call needed%label("title", "cloth")
    call needed%write(output("needs.html"), status)
    call expect(status == merge(hooke_not_built, hooke_ok, hooke_build_fact("chartjs") == ""), "as a page")
    call options%set("refine", .true.)
    call finer%create("needs", system, run, options)
    call finer%run()
    call expect(finer%row_count("parts") == 1 .and. finer%text("parts", 1, "part") == "cloth", "one part")
    call expect(nint(finer%number("parts", 1, "cells")) == 4, "of four cells")
    call needed%on_progress()
    call needed%destroy()
    call expect(lean%particle_count() <= 25, "the lean system keeps what it is of")
  end subroutine
end program
