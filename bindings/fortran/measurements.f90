! Measurements of a scene: one type with options, progress, a run, and tables of results.
module hooke_measurements
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int32_t, c_int64_t, c_ptr
  use hooke_base, only: accept, hooke_bad_call, is_3_by, refuse, to_c, to_series, zero_based
  use hooke_c_measurement
  use hooke_handles, only: hooke_handle, missing
  use hooke_option_tables, only: hooke_options
  use hooke_queries_of_measurement, only: hooke_measurement_queries
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_measurement

  type, extends(hooke_measurement_queries) :: hooke_measurement
  contains
    procedure :: series
    procedure :: lean          ! of needs: the lean system,
    procedure :: lean_run      ! its run
    procedure :: lean_position
  end type

contains

  ! ---- tables; rows are counted from 1, a record has one ----

  ! The library's array; valid until the next run.
  function series(self, table, row, column)
    class(hooke_measurement), intent(in) :: self
    character(*), intent(in) :: table, column
    integer, intent(in) :: row
    real(c_double), pointer, contiguous :: series(:)
    integer(c_int64_t) :: count(1)
    type(c_ptr) :: found
    count = 0
    found = c_measurement_series(self%address(), to_c(table), zero_based(row), to_c(column), count)
    series => to_series(found, count(1))
  end function

  ! ---- needs ----

  ! The lean system; hooke_bad_call before it was found.
  subroutine lean(self, system, status)
    class(hooke_measurement), intent(in) :: self
    class(hooke_system), intent(inout) :: system
    integer, intent(out), optional :: status
    if (missing(status, self)) return
    call lend(self, c_needs_lean(self%address()), system, status)
  end subroutine

  subroutine lean_run(self, options, status)
    class(hooke_measurement), intent(in) :: self
    class(hooke_options), intent(inout) :: options
    integer, intent(out), optional :: status
    if (missing(status, self)) return
    call lend(self, c_needs_lean_run(self%address()), options, status)
  end subroutine

  subroutine lend(self, address, object, status)
    class(hooke_measurement), intent(in) :: self
    type(c_ptr), intent(in) :: address
    class(hooke_handle), intent(inout) :: object
    integer, intent(out), optional :: status
    if (c_associated(address)) then
      call object%take(address, owner=self)
      call accept(0_c_int32_t, status)
    else
      call refuse(hooke_bad_call, "there is no lean system: of needs it is found by run()", status)
    end if
  end subroutine

  ! Positions of all particles of the full system at positions q of the lean one, NaN where they were left out.
  subroutine lean_position(self, q, position, status)
    class(hooke_measurement), intent(in) :: self
    real(c_double), intent(in), contiguous :: q(:, :)
    real(c_double), intent(inout), contiguous :: position(:, :)
    integer, intent(out), optional :: status
    type(hooke_system) :: system
    call self%lean(system, status)
    if (.not. system%exists()) return
    if (.not. is_3_by(q, int(system%particle_count(), c_int64_t), status)) return
    if (.not. is_3_by(position, int(self%number("full", 1, "particles"), c_int64_t), status)) return
    call accept(c_needs_lean_position(self%address(), q, position), status)
  end subroutine

end module
