! Made from include/hooke/io.h by make_interfaces.py.
module hooke_c_io
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_io_own_process() bind(c, name="hooke_io_own_process")
      import
    end function
    integer(c_int32_t) function c_scene_load(path, scene) bind(c, name="hooke_scene_load")
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), intent(out) :: scene
    end function
    integer(c_int32_t) function c_scene_parse(text, length, name, folder, scene) bind(c, name="hooke_scene_parse")
      import
      character(kind=c_char), intent(in), optional :: text(*), name(*), folder(*)
      integer(c_int64_t), value :: length
      type(c_ptr), intent(out) :: scene
    end function
    integer(c_int32_t) function c_scene_load_within(path, limits, scene) bind(c, name="hooke_scene_load_within")
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), value :: limits
      type(c_ptr), intent(out) :: scene
    end function
    integer(c_int32_t) function c_scene_parse_within(text, length, name, folder, limits, scene) &
      bind(c, name="hooke_scene_parse_within")
      import
      character(kind=c_char), intent(in), optional :: text(*), name(*), folder(*)
      integer(c_int64_t), value :: length
      type(c_ptr), value :: limits
      type(c_ptr), intent(out) :: scene
    end function
    integer(c_int32_t) function c_scene_commit(scene) bind(c, name="hooke_scene_commit")
      import
      type(c_ptr), value :: scene
    end function
    integer(c_int32_t) function c_scene_options_create(what, options) bind(c, name="hooke_scene_options_create")
      import
      character(kind=c_char), intent(in), optional :: what(*)
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_scene_options_apply(options, system) bind(c, name="hooke_scene_options_apply")
      import
      type(c_ptr), value :: options, system
    end function
    integer(c_int32_t) function c_scene_write(path, system, title, run) bind(c, name="hooke_scene_write")
      import
      character(kind=c_char), intent(in), optional :: path(*), title(*)
      type(c_ptr), value :: system, run
    end function
    integer(c_int32_t) function c_scene_of_system(system, title, run, name, folder, scene) &
      bind(c, name="hooke_scene_of_system")
      import
      type(c_ptr), value :: system, run
      character(kind=c_char), intent(in), optional :: title(*), name(*), folder(*)
      type(c_ptr), intent(out) :: scene
    end function
    subroutine c_scene_destroy(scene) bind(c, name="hooke_scene_destroy")
      import
      type(c_ptr), value :: scene
    end subroutine
    type(c_ptr) function c_scene_system(scene) bind(c, name="hooke_scene_system")
      import
      type(c_ptr), value :: scene
    end function
    type(c_ptr) function c_scene_run_options(scene) bind(c, name="hooke_scene_run_options")
      import
      type(c_ptr), value :: scene
    end function
    type(c_ptr) function c_scene_title(scene) bind(c, name="hooke_scene_title")
      import
      type(c_ptr), value :: scene
    end function
    type(c_ptr) function c_scene_text(scene) bind(c, name="hooke_scene_text")
      import
      type(c_ptr), value :: scene
    end function
    integer(c_int32_t) function c_mesh_read(path, options) bind(c, name="hooke_mesh_read")
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), value :: options
    end function
    integer(c_int32_t) function c_trajectory_create(path, system, integrator, scene_text, trajectory) &
      bind(c, name="hooke_trajectory_create")
      import
      character(kind=c_char), intent(in), optional :: path(*), scene_text(*)
      type(c_ptr), value :: system, integrator
      type(c_ptr), intent(out) :: trajectory
    end function
    integer(c_int32_t) function c_trajectory_write(trajectory, step, state) bind(c, name="hooke_trajectory_write")
      import
      type(c_ptr), value :: trajectory, state
      integer(c_int64_t), value :: step
    end function
    integer(c_int32_t) function c_trajectory_write_behind(trajectory) bind(c, name="hooke_trajectory_write_behind")
      import
      type(c_ptr), value :: trajectory
    end function
    integer(c_int32_t) function c_trajectory_sync(trajectory) bind(c, name="hooke_trajectory_sync")
      import
      type(c_ptr), value :: trajectory
    end function
    type(c_ptr) function c_trajectory_run(trajectory) bind(c, name="hooke_trajectory_run")
      import
      type(c_ptr), value :: trajectory
    end function
    integer(c_int32_t) function c_trajectory_close(trajectory, outcome) bind(c, name="hooke_trajectory_close")
      import
      type(c_ptr), value :: trajectory
      integer(c_int32_t), value :: outcome
    end function
    integer(c_int32_t) function c_estimate_write_h5(estimate, path) bind(c, name="hooke_estimate_write_h5")
      import
      type(c_ptr), value :: estimate
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int32_t) function c_record_open(path, record) bind(c, name="hooke_record_open")
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), intent(out) :: record
    end function
    subroutine c_record_close(record) bind(c, name="hooke_record_close")
      import
      type(c_ptr), value :: record
    end subroutine
    type(c_ptr) function c_record_text(record, what) bind(c, name="hooke_record_text")
      import
      type(c_ptr), value :: record
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    type(c_ptr) function c_record_options(record) bind(c, name="hooke_record_options")
      import
      type(c_ptr), value :: record
    end function
    integer(c_int64_t) function c_record_frame_count(record) bind(c, name="hooke_record_frame_count")
      import
      type(c_ptr), value :: record
    end function
    integer(c_int32_t) function c_record_read(record, frame, state) bind(c, name="hooke_record_read")
      import
      type(c_ptr), value :: record, state
      integer(c_int64_t), value :: frame
    end function
    integer(c_int32_t) function c_record_check(record, frame) bind(c, name="hooke_record_check")
      import
      type(c_ptr), value :: record
      integer(c_int64_t), value :: frame
    end function
    integer(c_int32_t) function c_record_size(record, what, rows, columns) bind(c, name="hooke_record_size")
      import
      type(c_ptr), value :: record
      character(kind=c_char), intent(in), optional :: what(*)
      integer(c_int64_t), intent(inout), optional :: rows(*), columns(*)
    end function
    integer(c_int32_t) function c_record_numbers(record, what, values) bind(c, name="hooke_record_numbers")
      import
      type(c_ptr), value :: record
      character(kind=c_char), intent(in), optional :: what(*)
      real(c_double), intent(inout), optional :: values(*)
    end function
    integer(c_int64_t) function c_record_place(record, what) bind(c, name="hooke_record_place")
      import
      type(c_ptr), value :: record
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int32_t) function c_comparison_file_create(path, system, comparison, scene_text, file) &
      bind(c, name="hooke_comparison_file_create")
      import
      character(kind=c_char), intent(in), optional :: path(*), scene_text(*)
      type(c_ptr), value :: system, comparison
      type(c_ptr), intent(out) :: file
    end function
    integer(c_int32_t) function c_comparison_file_close(file) bind(c, name="hooke_comparison_file_close")
      import
      type(c_ptr), value :: file
    end function
    integer(c_int32_t) function c_view_options_create(options) bind(c, name="hooke_view_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_view_create(record, options, view) bind(c, name="hooke_view_create")
      import
      type(c_ptr), value :: record, options
      type(c_ptr), intent(out) :: view
    end function
    integer(c_int32_t) function c_view_write(view, path, title) bind(c, name="hooke_view_write")
      import
      type(c_ptr), value :: view
      character(kind=c_char), intent(in), optional :: path(*), title(*)
    end function
    real(c_double) function c_view_number(view, what) bind(c, name="hooke_view_number")
      import
      type(c_ptr), value :: view
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    subroutine c_view_destroy(view) bind(c, name="hooke_view_destroy")
      import
      type(c_ptr), value :: view
    end subroutine
    integer(c_int32_t) function c_record_write_xdmf(record, path) bind(c, name="hooke_record_write_xdmf")
      import
      type(c_ptr), value :: record
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int32_t) function c_study_write_h5(study, path, scene_text, outcome) bind(c, name="hooke_study_write_h5")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: path(*), scene_text(*)
      integer(c_int32_t), value :: outcome
    end function
    integer(c_int32_t) function c_study_write_csv(study, path) bind(c, name="hooke_study_write_csv")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int32_t) function c_study_write_report(study, path, scene, command) &
      bind(c, name="hooke_study_write_report")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: path(*), scene(*), command(*)
    end function
    integer(c_int32_t) function c_needs_write_report(needs, path, scene, command) &
      bind(c, name="hooke_needs_write_report")
      import
      type(c_ptr), value :: needs
      character(kind=c_char), intent(in), optional :: path(*), scene(*), command(*)
    end function
  end interface
end module
