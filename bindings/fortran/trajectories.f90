! Trajectory files (HDF5): writing and reading.
module hooke_trajectories
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int32_t, c_int64_t, c_ptr
  use hooke_base, only: accept, hooke_ok, to_c
  use hooke_c_checkpoint, only: c_trajectory_resume
  use hooke_c_trajectory
  use hooke_handles, only: missing
  use hooke_integrators, only: hooke_integrator
  use hooke_option_tables, only: hooke_options
  use hooke_queries_of_record
  use hooke_states, only: hooke_state
  use hooke_systems, only: hooke_system
  use hooke_queries_of_trajectory
  implicit none
  private
  public :: hooke_trajectory, hooke_record

  ! A file being written. One that goes out of scope is closed as "stopped".
  type, extends(hooke_trajectory_queries) :: hooke_trajectory
  contains
    procedure :: resume => resume_trajectory
    procedure :: close => close_trajectory
  end type

  ! A file being read.
  type, extends(hooke_record_queries) :: hooke_record
    type(hooke_options) :: options ! of the run, with defaults filled in
  contains
    procedure :: numbers
    procedure :: refresh
  end type

contains

  ! Opens the file of a run that was stopped or killed, and sets a new integrator and its state to where it
  ! continues, for resume(). `finished`: there is nothing to continue, and the trajectory stays empty.
  subroutine resume_trajectory(self, path, system, integrator, state, finished, status)
    class(hooke_trajectory), intent(inout) :: self
    character(*), intent(in) :: path
    class(hooke_system), intent(in) :: system
    class(hooke_integrator), intent(inout) :: integrator
    class(hooke_state), intent(inout) :: state
    logical, intent(out), optional :: finished
    integer, intent(out), optional :: status
    type(c_ptr) :: trajectory
    integer(c_int32_t) :: code
    if (missing(status, system, integrator, state)) return
    code = c_trajectory_resume(to_c(path), system%address(), integrator%address(), state%address(), trajectory)
    if (present(finished)) finished = code == 0 .and. .not. c_associated(trajectory)
    if (code == 0 .and. c_associated(trajectory)) call self%take(trajectory, abandon_trajectory, system)
    call accept(code, status)
  end subroutine

  ! Writes the outcome, the status of hooke_integrator's run(), and closes the file.
  subroutine close_trajectory(self, outcome, status)
    class(hooke_trajectory), intent(inout) :: self
    integer, intent(in), optional :: outcome
    integer, intent(out), optional :: status
    integer(c_int32_t) :: ended
    type(c_ptr) :: trajectory
    if (missing(status, self)) return
    ended = hooke_ok
    if (present(outcome)) ended = int(outcome, c_int32_t)
    trajectory = self%give_up()
    call accept(c_trajectory_close(trajectory, ended), status)
  end subroutine

  ! A whole array of the file: "time", "step", "kinetic_energy" and so on, a column a frame; "springs", a column a spring,
  ! whose ends count from 1; "mass" and "species", a column a particle.
  subroutine numbers(self, what, values, status)
    class(hooke_record), intent(in) :: self
    character(*), intent(in) :: what
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer, intent(out), optional :: status
    integer(c_int64_t) :: rows(1), columns(1)
    integer(c_int32_t) :: code
    if (missing(status, self)) return
    rows = 0
    columns = 0
    code = c_record_size(self%address(), to_c(what), rows, columns)
    allocate (values(columns(1), rows(1)))
    if (code == 0) code = c_record_numbers(self%address(), to_c(what), values)
    if (code == 0 .and. what == "springs") values = values + 1
    call accept(code, status)
  end subroutine

  subroutine refresh(self)
    class(hooke_record), intent(inout) :: self
    call self%options%destroy()
    if (self%exists()) call self%options%take(c_record_options(self%address()), owner=self)
  end subroutine

end module
