! Scenes, trajectories and comparisons, written and read.
module writers
  use hooke
  implicit none

  type, extends(hooke_observer) :: writer
    type(hooke_trajectory) :: trajectory
  contains
    procedure :: see => write_frame
  end type

contains

  subroutine write_frame(self, step, state, stop_value)
    class(writer), intent(inout) :: self
    integer(hooke_long), intent(in) :: step
    type(hooke_state), intent(in) :: state
    integer, intent(inout) :: stop_value
    call self%trajectory%write(step, state, stop_value)
  end subroutine
end module

program test_files
  use check
  use hooke
  use parts, only: wind
  use scenes
  use writers
  implicit none

  call loading()
  call writing()
  if (hooke_build_fact("hdf5") /= "") call trajectories()
  if (hooke_build_fact("hdf5") /= "" .and. hooke_build_fact("sundials") /= "") call comparisons()
  call finish()

contains

  subroutine loading()
    type(hooke_scene) :: scene, other
    type(hooke_system) :: system
    integer :: status
    call scene%load("no-such-scene.json", status)
    call expect(status == hooke_bad_value, "no such file")
    call expect_text(hooke_message(), "no-such-scene.json", "by name")
    call scene%load("examples/scenes/rope.json")
    call expect(scene%system%particle_count() == 25 .and. .not. scene%system%is_committed(), "a rope, still open")
    call expect(scene%title() /= "" .and. index(scene%text(), """hooke""") > 0, "its title and text")
    call expect(scene%run%number("duration") > 0, "and its run")
    other = scene
    call other%commit()
    call expect(scene%system%is_committed(), "two names of one scene")
    system = scene%system
    call scene%destroy()
    call other%destroy()
    call expect(system%particle_count() == 25, "a system keeps its scene")
    call scene%parse('{"hooke": 1, "particles": {"position": [[0, 0, 0]], "mass": -1}}', "here", status=status)
    call expect(status == hooke_bad_value, "no negative mass")
    call expect_text(hooke_message(), "here:1", "with the place")
    call scene%parse('{"hooke": 1, "particles": {"position": [[0, 0, 0], [1, 2, 3]], "mass": 1}}')
    call expect(scene%system%particle_count() == 2, "a scene from text")
  end subroutine

  subroutine writing()
    type(hooke_system) :: system, callback
    type(hooke_options) :: run, spring
    type(hooke_scene) :: scene
    type(hooke_state) :: first, second
    type(wind), target :: force
    integer :: status
    call make_cloth(system)
    call make_run(run, "verlet", 1e-3_hooke_real, 0.25_hooke_real)
    call system%write_scene(output("cloth.json"), "from Fortran", run)
    call scene%load(output("cloth.json"))
    call expect(scene%title() == "from Fortran" .and. scene%run%text("method") == "verlet", "title and run")
    call scene%commit()
    call first%create(system)
    call second%create(scene%system)
    call expect(same_count(first%x, second%x) == 75, "the same positions")
    call expect(scene%system%spring_count() == system%spring_count(), "and springs")
    call callback%create()
    call callback%add_particles(reshape([0, 0, 0]*1.0_hooke_real, [3, 1]), 1.0_hooke_real)
    call spring%create("springs")
    call callback%set_force(force)
    call callback%commit()
    call callback%write_scene(output("callback.json"), status=status)
    call expect(status == hooke_unsuited, "a procedure is no scene")
  end subroutine

  subroutine trajectories()
    type(hooke_scene) :: scene
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state, read_back
    type(writer), target :: frames
    type(hooke_record) :: record, other
    type(hooke_measurement) :: verified
    integer :: status
    call scene%load("examples/scenes/rope.json")
    call scene%commit()
    call scene%run%set("duration", 0.1_hooke_real)
    call scene%run%set("every", 0.01_hooke_real)
    call integrator%create(scene%system, scene%run)
    call state%create(scene%system)
    call frames%trajectory%create(output("rope.h5"), scene%system, integrator, scene%text())
    call frames%trajectory%write_behind()
    call integrator%on_frame(frames)
    call integrator%run(state, status)
    call frames%trajectory%close(status)
    call expect(.not. frames%trajectory%exists(), "closed")
    call frames%trajectory%close(hooke_ok, status)
    call expect(status == hooke_bad_call, "once")
    call record%open(output("rope.h5"))
    other = record
    call expect(other%frame_count() == 11 .and. other%text("status") == "finished", "eleven frames")
    call expect(other%text("scene") == scene%text() .and. other%text("nothing") == "", "the scene")
    call expect(other%options%text("method") == scene%run%text("method"), "and the run")
    call read_back%create(scene%system)
    call record%read(-1, read_back)
    call expect(same_count(read_back%x, state%x) == state%size(), "the last frame is the final state")
    call record%read(11, read_back)
    call expect(same_count(read_back%x, state%x) == state%size(), "which is frame 11")
    call record%read(1, read_back)
    call expect(same(read_back%time(), 0.0_hooke_real), "frame 1 is the first")
    call record%read(0, read_back, status)
    call expect(status == hooke_bad_value, "there is no frame 0")
    call record%read(12, read_back, status)
    call expect(status == hooke_bad_value, "nor a frame 12")
    call record%open("no-such-file.h5", status)
    call expect(status /= hooke_ok .and. record%exists(), "a record that is open stays")
    call verified%create_verify(output("rope.h5"))
    call verified%run()
    call expect(verified%text("verify", 1, "verdict") == "agrees", "the file reproduces from its scene")
    call expect(nint(verified%number("verify", 1, "frames_checked")) == 11, "in every frame")
    call abandoned(scene)
  end subroutine

  ! A file that is not closed explicitly is closed with its variable.
  subroutine abandoned(scene)
    type(hooke_scene), intent(in) :: scene
    type(hooke_record) :: record
    call leave(scene)
    call record%open(output("left.h5"))
    call expect(record%text("status") == "stopped" .and. record%frame_count() == 1, "with the frame that it had")
    call record%destroy()
    call goes_on(scene)
  end subroutine

  ! The missing frames, in the same file; and from a checkpoint.
  subroutine goes_on(scene)
    type(hooke_scene), intent(in) :: scene
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state, again
    type(writer), target :: frames
    type(hooke_record) :: record
    logical :: finished
    integer :: status
    call integrator%create(scene%system, scene%run)
    call state%create(scene%system)
    call frames%trajectory%resume(output("left.h5"), scene%system, integrator, state, finished)
    call expect(.not. finished .and. index(frames%trajectory%origin(), "no checkpoint") > 0, "from the first frame")
    call integrator%on_frame(frames)
    call integrator%on_checkpoint()
    call integrator%resume(state)
    call frames%trajectory%checkpoint(integrator, state)
    call frames%trajectory%close(hooke_ok)
    call record%open(output("left.h5"))
    call expect(record%text("status") == "finished" .and. record%frame_count() == 11, "to the last one")
    call frames%trajectory%resume(output("left.h5"), scene%system, integrator, state, finished)
    call expect(finished, "and then no further")
    call integrator%write_checkpoint(output("rope.checkpoint"), state, "a run")
    call integrator%create(scene%system, scene%run)
    call again%create(scene%system)
    call integrator%read_checkpoint(output("rope.checkpoint"), again, "another", status)
    call expect(status == hooke_bad_value, "of another run")
    call integrator%read_checkpoint(output("rope.checkpoint"), again)
    call expect(same_count(again%x, state%x) == state%size(), "the same state")
  end subroutine

  subroutine leave(scene)
    type(hooke_scene), intent(in) :: scene
    type(hooke_trajectory) :: trajectory
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    call integrator%create(scene%system, scene%run)
    call state%create(scene%system)
    call trajectory%create(output("left.h5"), scene%system, integrator)
    call trajectory%write(0_hooke_long, state)
  end subroutine

  subroutine comparisons()
    type(hooke_system) :: system
    type(hooke_options) :: run, options
    type(hooke_measurement) :: comparison
    type(hooke_record) :: record
    call make_oscillator(system)
    call make_run(run, "rk4", 1e-2_hooke_real, 0.1_hooke_real)
    call options%create("study")
    call options%set("methods", "rk4")
    call options%set("once", .true.)
    call comparison%create("study", system, run, options)
    call comparison%run()
    call comparison%write(output("comparison.h5"))
    call record%open(output("comparison.h5"))
    call expect(record%frame_count() == 11, "the reference in the file of a comparison")
  end subroutine
end program
