! Options of scenes, bounds of options, and a system as a scene.
program test_make
  use check
  use hooke
  use scenes
  implicit none
  type(hooke_system) :: system
  type(hooke_options) :: options, run
  type(hooke_scene) :: scene
  type(hooke_state) :: first, second
  integer :: status, row

  call options%create("no such thing", status)
  call expect(status == hooke_bad_value, "no options of it")
  call options%create("scene")
  call options%set("gravity", [0.0_hooke_real, -1.5_hooke_real, 0.0_hooke_real])
  call system%create()
  call system%add_particles(reshape([0, 1, 0]*1.0_hooke_real, [3, 1]), 2.0_hooke_real)
  call system%apply(options)
  call system%commit()
  call first%create(system)
  call expect_near(system%energy("gravity", first%q), 3.0_hooke_real, 1e-14_hooke_real, "gravity is applied")

  call run%create("run")
  do row = 1, run%row_count()
    if (run%row(row, "name") == "step") exit
  end do
  call expect(same(run%row_number(row, "low"), 0.0_hooke_real) .and. same(run%row_number(row, "above_low"), &
    1.0_hooke_real), "a step is above 0")
  call expect(len(hooke_part_kind(1, "summary")) > 5, "what a rope is")

  call make_cloth(system)
  call make_run(run, "verlet", 1e-3_hooke_real, 0.25_hooke_real)
  call scene%of_system(system, "as a scene", run)
  call expect(scene%title() == "as a scene" .and. scene%run%text("method") == "verlet", "title and run")
  call scene%commit()
  call first%create(system)
  call second%create(scene%system)
  call expect(same_count(first%x, second%x) == 75, "the same positions")
  call finish()
end program
