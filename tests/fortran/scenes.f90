! Scenes shared by the tests.
module scenes
  use hooke
  implicit none

contains

  ! A mass on a spring of the length law: 0.5 kg, 20 N/m, 1 m, pinned at particle 1 and stretched to 1.25 m;
  ! omega^2 = 40.
  subroutine make_oscillator(system, damping)
    type(hooke_system), intent(inout) :: system
    real(hooke_real), intent(in), optional :: damping
    type(hooke_options) :: spring
    real(hooke_real) :: position(3, 2)
    position = 0
    position(1, 2) = 1.25_hooke_real
    call system%create()
    call system%add_particles(position, [1.0_hooke_real, 0.5_hooke_real])
    call system%pin(1)
    call spring%create("springs")
    call spring%set("law", "length")
    call spring%set("stiffness", 20)
    call spring%set("rest_length", 1)
    if (present(damping)) call spring%set("damping", damping)
    call system%add_springs(reshape([1, 2], [2, 1]), spring, "spring")
    call system%commit()
  end subroutine

  ! A cloth of 5 x 5 particles pinned at its corners, with weak bending.
  subroutine make_cloth(system)
    type(hooke_system), intent(inout) :: system
    type(hooke_options) :: cloth
    call system%create()
    call cloth%create("cloth")
    call cloth%set("origin", [0, 0, 0])
    call cloth%set("edges", [1, 0, 0, 0, 0, 1])
    call cloth%set("size", [5, 5])
    call cloth%set("mass", 0.5_hooke_real)
    call cloth%set("pinned", "top-corners")
    call cloth%set("structural.stiffness", 50)
    call cloth%set("structural.damping", 0.05_hooke_real)
    call cloth%set("shear.stiffness", 5)
    call system%add_part("cloth", cloth, "cloth")
    call system%set_gravity([0.0_hooke_real, -9.81_hooke_real, 0.0_hooke_real])
    call system%commit()
  end subroutine

  subroutine make_run(run, method, step, duration)
    type(hooke_options), intent(inout) :: run
    character(*), intent(in) :: method
    real(hooke_real), intent(in) :: step, duration
    call run%create("run")
    call run%set("method", method)
    call run%set("step", step)
    call run%set("duration", duration)
  end subroutine
end module
