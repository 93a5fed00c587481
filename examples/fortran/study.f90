! Which method and which step for an error that one can live with: a study, and the run that it recommends.
program study
  use hooke
  implicit none
  type(hooke_system) :: system
  type(hooke_options) :: cloth, run, options
  type(hooke_measurement) :: found
  type(hooke_integrator) :: integrator
  type(hooke_state) :: state
  real(hooke_real), parameter :: want = 1e-3_hooke_real ! m
  integer :: row, status

  call cloth%create("cloth")
  call cloth%set("origin", [0, 0, 0])
  call cloth%set("edges", [1, 0, 0, 0, 0, 1])
  call cloth%set("size", [6, 6])
  call cloth%set("mass", 0.5_hooke_real)
  call cloth%set("pinned", "top-corners")
  call cloth%set("structural.stiffness", 50)
  call system%create()
  call system%add_part("cloth", cloth)
  call system%set_gravity([0.0_hooke_real, -9.81_hooke_real, 0.0_hooke_real])
  call system%commit()

  call run%create("run")
  call run%set("duration", 0.2_hooke_real)
  call options%create("study")
  call options%set("methods", "symplectic-euler,verlet,rk4")
  call options%set("want", want)
  call found%create("study", system, run, options, status)
  if (status == hooke_not_built) then
    print "(2a)", "no study: ", hooke_message()
    stop
  end if
  call found%run()
  do row = 1, found%row_count("rows")
    print "(a18, 2es12.3)", found%text("rows", row, "method"), &
      found%number("rows", row, "step"), found%number("rows", row, "error")
  end do

  call run%set("method", found%text("recommendation", 1, "method"))
  call run%set("step", found%number("recommendation", 1, "step"))
  call integrator%create(system, run)
  call state%create(system)
  call integrator%run(state)
  print "(3a, es9.3, a, i0, a)", "recommended: ", run%text("method"), " with steps of ", run%number("step"), " s, ", &
    integrator%count("steps"), " of them"
end program
