"""Every function of the library with the types of its result and arguments: the only place where they are
written.

Handles are pointers to types without members, so that a state cannot be passed where a system is expected.
Arguments of callbacks that are arrays or states arrive as plain addresses, which is quicker than typed
pointers.
"""

from __future__ import annotations

from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int32, c_int64, c_void_p
from typing import Any


class STATUS(c_int32):
    """Marks a result that is a status: anything but 0 is raised."""


class OUTCOME(c_int32):
    """Marks the status of a run: a failure is raised, an outcome (0 or more) returned."""


def _handle(name: str) -> Any:
    return POINTER(type(name, (Structure,), {}))


OPTIONS = _handle("hooke_options")
SYSTEM = _handle("hooke_system")
STATE = _handle("hooke_state")
INTEGRATOR = _handle("hooke_integrator")
SCENE = _handle("hooke_scene")
TRAJECTORY = _handle("hooke_trajectory")
COMPARISON = _handle("hooke_comparison")
COMPARISON_FILE = _handle("hooke_comparison_file")
STUDY = _handle("hooke_study")
ESTIMATE = _handle("hooke_estimate")
WHY = _handle("hooke_why")
RECORD = _handle("hooke_record")
VIEW = _handle("hooke_view")
VERIFY = _handle("hooke_verify")
LIMIT = _handle("hooke_limit")
COST = _handle("hooke_cost")
NEEDS = _handle("hooke_needs")

INT32, INT64, DOUBLE, TEXT, ADDRESS = c_int32, c_int64, c_double, c_char_p, c_void_p
DOUBLES, INTEGERS = POINTER(c_double), POINTER(c_int64)

FORCE = CFUNCTYPE(INT32, INT64, DOUBLE, ADDRESS, ADDRESS, ADDRESS, ADDRESS)
FORCE_PRODUCT = CFUNCTYPE(INT32, INT64, DOUBLE, ADDRESS, ADDRESS, ADDRESS, ADDRESS, ADDRESS, ADDRESS)
DRIVE = CFUNCTYPE(INT32, INT64, DOUBLE, ADDRESS, ADDRESS, ADDRESS)
RATE = CFUNCTYPE(INT32, INT64, DOUBLE, ADDRESS, ADDRESS, ADDRESS)
OBSERVER = CFUNCTYPE(INT32, INT64, ADDRESS, ADDRESS)
PROGRESS = CFUNCTYPE(INT32, DOUBLE, TEXT, ADDRESS)
WARNING = CFUNCTYPE(INT32, TEXT, TEXT, DOUBLE, DOUBLE, INT64, INT64, ADDRESS)
COMPARISON_FRAME = CFUNCTYPE(INT32, TEXT, INT64, INT64, ADDRESS, ADDRESS)

# name: (result, argument, argument, ...)
PROTOTYPES = {
    # base.h
    "hooke_last_error": (TEXT,),
    "hooke_status_name": (TEXT, INT32),
    "hooke_version": (TEXT,),
    "hooke_abi": (INT32,),
    "hooke_build_fact": (TEXT, TEXT),
    # options.h
    "hooke_options_copy": (STATUS, OPTIONS, POINTER(OPTIONS)),
    "hooke_options_destroy": (None, OPTIONS),
    "hooke_options_set_number": (STATUS, OPTIONS, TEXT, DOUBLE),
    "hooke_options_set_numbers": (STATUS, OPTIONS, TEXT, INT64, DOUBLES),
    "hooke_options_set_text": (STATUS, OPTIONS, TEXT, TEXT),
    "hooke_options_unset": (STATUS, OPTIONS, TEXT),
    "hooke_options_is_set": (INT32, OPTIONS, TEXT),
    "hooke_options_number_count": (INT64, OPTIONS, TEXT),
    "hooke_options_numbers": (DOUBLES, OPTIONS, TEXT),
    "hooke_options_number": (DOUBLE, OPTIONS, TEXT),
    "hooke_options_text": (TEXT, OPTIONS, TEXT),
    "hooke_options_row_count": (INT64, OPTIONS),
    "hooke_options_row": (TEXT, OPTIONS, INT64, TEXT),
    "hooke_options_row_number": (DOUBLE, OPTIONS, INT64, TEXT),
    # system.h: building
    "hooke_system_create": (STATUS, POINTER(SYSTEM)),
    "hooke_system_destroy": (None, SYSTEM),
    "hooke_system_limit_memory": (STATUS, SYSTEM, DOUBLE),
    "hooke_system_add_particles": (STATUS, SYSTEM, INT64, DOUBLES, DOUBLES, INT64, DOUBLES, INTEGERS),
    "hooke_system_pin": (STATUS, SYSTEM, INT64, INTEGERS),
    "hooke_spring_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_system_add_springs": (STATUS, SYSTEM, TEXT, INT64, INTEGERS, OPTIONS),
    "hooke_altitude_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_system_add_altitude": (STATUS, SYSTEM, TEXT, INT64, INTEGERS, OPTIONS),
    "hooke_system_add_bending": (STATUS, SYSTEM, TEXT, INT64, INTEGERS, INT64, DOUBLES),
    "hooke_system_set_gravity": (STATUS, SYSTEM, DOUBLES),
    "hooke_system_set_drag": (STATUS, SYSTEM, DOUBLE),
    "hooke_system_set_force": (STATUS, SYSTEM, FORCE, FORCE_PRODUCT, ADDRESS),
    "hooke_system_drive_harmonic": (STATUS, SYSTEM, INT64, INTEGERS, DOUBLES, DOUBLE, DOUBLE),
    "hooke_system_drive_table": (STATUS, SYSTEM, INT64, INTEGERS, INT64, DOUBLES, DOUBLES),
    "hooke_system_drive_callback": (STATUS, SYSTEM, INT64, INTEGERS, DRIVE, ADDRESS),
    "hooke_system_commit": (STATUS, SYSTEM),
    # system.h: asking
    "hooke_system_is_committed": (INT32, SYSTEM),
    "hooke_system_particle_count": (INT64, SYSTEM),
    "hooke_system_free_count": (INT64, SYSTEM),
    "hooke_system_spring_count": (INT64, SYSTEM),
    "hooke_system_dropped_spring_count": (INT64, SYSTEM),
    "hooke_system_idle_count": (INT64, SYSTEM),
    "hooke_system_group_count": (INT64, SYSTEM),
    "hooke_system_group_name": (TEXT, SYSTEM, INT64),
    "hooke_system_group_size": (INT64, SYSTEM, INT64),
    "hooke_system_mass": (DOUBLES, SYSTEM),
    "hooke_system_inverse_mass": (DOUBLES, SYSTEM),
    "hooke_system_spring_ends": (STATUS, SYSTEM, INTEGERS),
    "hooke_system_spring_material": (STATUS, SYSTEM, DOUBLES, DOUBLES, DOUBLES),
    "hooke_system_bending_count": (INT64, SYSTEM),
    "hooke_system_bending_group_count": (INT64, SYSTEM),
    "hooke_system_bending_group_name": (TEXT, SYSTEM, INT64),
    "hooke_system_bending_group_size": (INT64, SYSTEM, INT64),
    "hooke_system_bending_ends": (STATUS, SYSTEM, INTEGERS),
    "hooke_system_bending_coefficient": (STATUS, SYSTEM, DOUBLES),
    "hooke_anchor_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_system_add_anchors": (STATUS, SYSTEM, TEXT, INT64, INTEGERS, OPTIONS),
    "hooke_system_anchor_count": (INT64, SYSTEM),
    "hooke_system_anchors": (STATUS, SYSTEM, INTEGERS, DOUBLES, DOUBLES, DOUBLES, DOUBLES),
    "hooke_system_altitude_count": (INT64, SYSTEM),
    "hooke_system_altitude_group_count": (INT64, SYSTEM),
    "hooke_system_altitude_group_name": (TEXT, SYSTEM, INT64),
    "hooke_system_altitude_group_size": (INT64, SYSTEM, INT64),
    "hooke_system_altitude_ends": (STATUS, SYSTEM, INTEGERS),
    "hooke_system_altitude_material": (STATUS, SYSTEM, DOUBLES, DOUBLES, DOUBLES),
    "hooke_system_altitude_lengths": (STATUS, SYSTEM, DOUBLES, DOUBLES),
    "hooke_system_derived_count": (INT64, SYSTEM),
    "hooke_system_derived_text": (TEXT, SYSTEM, INT64, TEXT),
    "hooke_system_derived_value": (DOUBLE, SYSTEM, INT64),
    "hooke_system_force_count": (INT64, SYSTEM),
    "hooke_system_force_name": (TEXT, SYSTEM, INT64),
    "hooke_system_memory": (INT64, SYSTEM),
    "hooke_system_spring_memory": (INT64, SYSTEM),
    "hooke_system_force": (STATUS, SYSTEM, DOUBLE, DOUBLES, DOUBLES, DOUBLES),
    "hooke_system_acceleration": (STATUS, SYSTEM, DOUBLE, DOUBLES, DOUBLES, DOUBLES),
    "hooke_system_coincident_springs": (INT64, SYSTEM, DOUBLES),
    "hooke_system_derivative_product": (STATUS, SYSTEM, DOUBLE, DOUBLES, DOUBLES, DOUBLES, DOUBLES, DOUBLES),
    "hooke_system_block_count": (INT64, SYSTEM),
    "hooke_system_derivative_pattern": (STATUS, SYSTEM, INTEGERS, INTEGERS),
    "hooke_system_derivative_blocks": (STATUS, SYSTEM, DOUBLES, DOUBLES, DOUBLES, DOUBLES),
    "hooke_system_kinetic_energy": (DOUBLE, SYSTEM, DOUBLES),
    "hooke_system_spring_energy": (DOUBLE, SYSTEM, DOUBLES),
    "hooke_system_bending_energy": (DOUBLE, SYSTEM, DOUBLES),
    "hooke_system_altitude_energy": (DOUBLE, SYSTEM, DOUBLES),
    "hooke_system_gravity_energy": (DOUBLE, SYSTEM, DOUBLES),
    "hooke_system_potential_energy": (DOUBLE, SYSTEM, DOUBLES),
    "hooke_system_energy": (DOUBLE, SYSTEM, DOUBLES, DOUBLES),
    "hooke_system_dissipated_power": (DOUBLE, SYSTEM, DOUBLES, DOUBLES),
    "hooke_system_momentum": (None, SYSTEM, DOUBLES, DOUBLES),
    "hooke_system_angular_momentum": (None, SYSTEM, DOUBLES, DOUBLES, DOUBLES),
    # build.h
    "hooke_part_kind_count": (INT64,),
    "hooke_part_kind": (TEXT, INT64),
    "hooke_part_kind_summary": (TEXT, INT64),
    "hooke_part_options_create": (STATUS, TEXT, POINTER(OPTIONS)),
    "hooke_system_add_part": (STATUS, SYSTEM, TEXT, TEXT, OPTIONS, INTEGERS, INTEGERS),
    "hooke_mesh_set": (STATUS, OPTIONS, INT64, DOUBLES, INT64, INTEGERS),
    # state.h
    "hooke_state_create": (STATUS, SYSTEM, POINTER(STATE)),
    "hooke_state_create_first_order": (STATUS, INT64, POINTER(STATE)),
    "hooke_state_destroy": (None, STATE),
    "hooke_state_copy": (STATUS, STATE, STATE),
    "hooke_state_time": (DOUBLE, STATE),
    "hooke_state_set_time": (None, STATE, DOUBLE),
    "hooke_state_size": (INT64, STATE),
    "hooke_state_position": (DOUBLES, STATE),
    "hooke_state_velocity": (DOUBLES, STATE),
    # integrator.h
    "hooke_method_count": (INT64,),
    "hooke_method_name": (TEXT, INT64),
    "hooke_method_summary": (TEXT, TEXT),
    "hooke_method_is_adaptive": (INT32, TEXT),
    "hooke_method_is_built": (INT32, TEXT),
    "hooke_run_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_integrator_create": (STATUS, SYSTEM, OPTIONS, POINTER(INTEGRATOR)),
    "hooke_integrator_create_first_order": (STATUS, INT64, RATE, ADDRESS, OPTIONS, POINTER(INTEGRATOR)),
    "hooke_integrator_destroy": (None, INTEGRATOR),
    "hooke_integrator_options": (OPTIONS, INTEGRATOR),
    "hooke_integrator_on_frame": (STATUS, INTEGRATOR, OBSERVER, ADDRESS),
    "hooke_integrator_on_step": (STATUS, INTEGRATOR, INT64, OBSERVER, ADDRESS),
    "hooke_integrator_frame_count": (INT64, INTEGRATOR),
    "hooke_integrator_on_checkpoint": (STATUS, INTEGRATOR, OBSERVER, ADDRESS),
    "hooke_integrator_on_progress": (STATUS, INTEGRATOR, DOUBLE, PROGRESS, ADDRESS),
    "hooke_integrator_run": (OUTCOME, INTEGRATOR, STATE),
    "hooke_integrator_resume": (OUTCOME, INTEGRATOR, STATE),
    "hooke_integrator_step": (OUTCOME, INTEGRATOR, STATE, INT64),
    "hooke_integrator_count": (INT64, INTEGRATOR, TEXT),
    "hooke_integrator_wall_seconds": (DOUBLE, INTEGRATOR),
    "hooke_integrator_recent_count": (INT64, INTEGRATOR),
    "hooke_integrator_recent": (STATUS, INTEGRATOR, INT64, STATE),
    "hooke_integrator_stop_value": (INT32, INTEGRATOR),
    "hooke_integrator_diverged_at": (DOUBLE, INTEGRATOR),
    # measure.h
    "hooke_step_bound": (STATUS, SYSTEM, TEXT, DOUBLES, DOUBLES),
    "hooke_step_bounds": (STATUS, SYSTEM, DOUBLES, DOUBLES),
    "hooke_comparison_create": (STATUS, SYSTEM, OPTIONS, POINTER(COMPARISON)),
    "hooke_comparison_destroy": (None, COMPARISON),
    "hooke_comparison_add": (STATUS, COMPARISON, TEXT),
    "hooke_comparison_on_progress": (None, COMPARISON, PROGRESS, ADDRESS),
    "hooke_comparison_on_frame": (None, COMPARISON, COMPARISON_FRAME, ADDRESS),
    "hooke_comparison_run": (OUTCOME, COMPARISON),
    "hooke_comparison_row_count": (INT64, COMPARISON),
    "hooke_comparison_text": (TEXT, COMPARISON, INT64, TEXT),
    "hooke_comparison_number": (DOUBLE, COMPARISON, INT64, TEXT),
    "hooke_comparison_reference": (TEXT, COMPARISON),
    "hooke_comparison_frame_count": (INT64, COMPARISON),
    "hooke_comparison_series": (DOUBLES, COMPARISON, INT64, TEXT),
    # estimate.h
    "hooke_estimate_create": (STATUS, SYSTEM, DOUBLE, POINTER(ESTIMATE)),
    "hooke_estimate_destroy": (None, ESTIMATE),
    "hooke_estimate_on_progress": (None, ESTIMATE, PROGRESS, ADDRESS),
    "hooke_estimate_pick": (STATUS, ESTIMATE, TEXT, OPTIONS),
    "hooke_estimate_begin": (STATUS, ESTIMATE, INTEGRATOR, STATE),
    "hooke_estimate_see": (INT32, INT64, STATE, ADDRESS),
    "hooke_estimate_measure": (STATUS, ESTIMATE, INTEGRATOR, STATE),
    "hooke_estimate_refine": (STATUS, ESTIMATE, OPTIONS),
    "hooke_estimate_number": (DOUBLE, ESTIMATE, TEXT),
    "hooke_estimate_text": (TEXT, ESTIMATE, TEXT),
    "hooke_estimate_write_h5": (STATUS, ESTIMATE, TEXT),
    # study.h
    "hooke_study_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_study_create": (STATUS, SYSTEM, OPTIONS, OPTIONS, POINTER(STUDY)),
    "hooke_study_destroy": (None, STUDY),
    "hooke_study_on_progress": (None, STUDY, PROGRESS, ADDRESS),
    "hooke_study_run": (OUTCOME, STUDY),
    "hooke_study_reference": (TEXT, STUDY, TEXT),
    "hooke_study_figure": (DOUBLE, STUDY, TEXT),
    "hooke_study_row_count": (INT64, STUDY),
    "hooke_study_text": (TEXT, STUDY, INT64, TEXT),
    "hooke_study_number": (DOUBLE, STUDY, INT64, TEXT),
    "hooke_study_frame_count": (INT64, STUDY),
    "hooke_study_series": (DOUBLES, STUDY, INT64, TEXT),
    "hooke_study_order": (DOUBLE, STUDY, TEXT, TEXT),
    "hooke_study_statistic": (DOUBLE, STUDY, TEXT, TEXT, TEXT),
    "hooke_study_order_note": (TEXT, STUDY, TEXT),
    "hooke_study_recommend": (OUTCOME, STUDY, DOUBLE),
    "hooke_study_recommendation_text": (TEXT, STUDY, TEXT),
    "hooke_study_recommendation_number": (DOUBLE, STUDY, TEXT),
    "hooke_study_pick": (OUTCOME, SYSTEM, OPTIONS, DOUBLE, PROGRESS, ADDRESS),
    # limit.h
    "hooke_limit_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_limit_create": (STATUS, SYSTEM, OPTIONS, OPTIONS, POINTER(LIMIT)),
    "hooke_limit_destroy": (None, LIMIT),
    "hooke_limit_on_progress": (None, LIMIT, PROGRESS, ADDRESS),
    "hooke_limit_find": (OUTCOME, LIMIT, STATE),
    "hooke_limit_along": (OUTCOME, LIMIT, STATE),
    "hooke_limit_figure": (DOUBLE, LIMIT, TEXT),
    "hooke_limit_row_count": (INT64, LIMIT),
    "hooke_limit_text": (TEXT, LIMIT, INT64, TEXT),
    "hooke_limit_number": (DOUBLE, LIMIT, INT64, TEXT),
    "hooke_limit_blame_count": (INT64, LIMIT),
    "hooke_limit_blame_number": (DOUBLE, LIMIT, INT64, TEXT),
    "hooke_limit_blame_text": (TEXT, LIMIT, INT64, TEXT),
    "hooke_limit_mover_count": (INT64, LIMIT),
    "hooke_limit_mover_number": (DOUBLE, LIMIT, INT64, TEXT),
    "hooke_limit_remedy_text": (TEXT, LIMIT, TEXT),
    "hooke_limit_remedy_number": (DOUBLE, LIMIT, TEXT),
    "hooke_limit_mode_count": (INT64, LIMIT),
    "hooke_limit_mode_number": (DOUBLE, LIMIT, INT64, TEXT),
    "hooke_limit_shape": (DOUBLES, LIMIT),
    "hooke_limit_of_mode": (DOUBLE, TEXT, DOUBLE, DOUBLE),
    # cost.h
    "hooke_cost_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_cost_create": (STATUS, SYSTEM, OPTIONS, OPTIONS, POINTER(COST)),
    "hooke_cost_destroy": (None, COST),
    "hooke_cost_on_progress": (None, COST, PROGRESS, ADDRESS),
    "hooke_cost_find": (OUTCOME, COST, STATE),
    "hooke_cost_method": (TEXT, COST),
    "hooke_cost_figure": (DOUBLE, COST, TEXT),
    "hooke_cost_row_count": (INT64, COST),
    "hooke_cost_text": (TEXT, COST, INT64, TEXT),
    "hooke_cost_number": (DOUBLE, COST, INT64, TEXT),
    # needs.h
    "hooke_needs_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_needs_create": (STATUS, SYSTEM, OPTIONS, OPTIONS, POINTER(NEEDS)),
    "hooke_needs_destroy": (None, NEEDS),
    "hooke_needs_on_progress": (None, NEEDS, PROGRESS, ADDRESS),
    "hooke_needs_find": (OUTCOME, NEEDS),
    "hooke_needs_refine": (OUTCOME, NEEDS),
    "hooke_needs_figure": (DOUBLE, NEEDS, TEXT),
    "hooke_needs_word": (TEXT, NEEDS, TEXT),
    "hooke_needs_row_count": (INT64, NEEDS),
    "hooke_needs_text": (TEXT, NEEDS, INT64, TEXT),
    "hooke_needs_number": (DOUBLE, NEEDS, INT64, TEXT),
    "hooke_needs_lean": (SYSTEM, NEEDS),
    "hooke_needs_lean_run": (OPTIONS, NEEDS),
    "hooke_needs_lean_particle": (INT64, NEEDS, INT64),
    "hooke_needs_lean_position": (STATUS, NEEDS, DOUBLES, DOUBLES),
    "hooke_needs_part_count": (INT64, NEEDS),
    "hooke_needs_part_text": (TEXT, NEEDS, INT64, TEXT),
    "hooke_needs_part_number": (DOUBLE, NEEDS, INT64, TEXT),
    # why.h
    "hooke_integrator_on_warning": (STATUS, INTEGRATOR, WARNING, ADDRESS),
    "hooke_why_create": (STATUS, INTEGRATOR, c_double, PROGRESS, ADDRESS, POINTER(WHY)),
    "hooke_why_create_kept": (STATUS, SYSTEM, OPTIONS, STATE, STATE, c_double, PROGRESS, ADDRESS, POINTER(WHY)),
    "hooke_why_destroy": (None, WHY),
    "hooke_why_text": (TEXT, WHY, TEXT),
    "hooke_why_number": (DOUBLE, WHY, TEXT),
    "hooke_why_blame_count": (INT64, WHY),
    "hooke_why_blame_number": (DOUBLE, WHY, INT64, TEXT),
    "hooke_why_blame_text": (TEXT, WHY, INT64, TEXT),
    "hooke_why_advice_count": (INT64, WHY),
    "hooke_why_advice_text": (TEXT, WHY, INT64, TEXT),
    "hooke_why_advice_apply": (STATUS, WHY, INT64, OPTIONS),
    # io.h
    "hooke_io_own_process": (STATUS,),
    "hooke_scene_load": (STATUS, TEXT, POINTER(SCENE)),
    "hooke_scene_parse": (STATUS, TEXT, INT64, TEXT, TEXT, POINTER(SCENE)),
    "hooke_scene_load_within": (STATUS, TEXT, OPTIONS, POINTER(SCENE)),
    "hooke_scene_parse_within": (STATUS, TEXT, INT64, TEXT, TEXT, OPTIONS, POINTER(SCENE)),
    "hooke_scene_commit": (STATUS, SCENE),
    "hooke_scene_options_create": (STATUS, TEXT, POINTER(OPTIONS)),
    "hooke_scene_options_apply": (STATUS, OPTIONS, SYSTEM),
    "hooke_scene_write": (STATUS, TEXT, SYSTEM, TEXT, OPTIONS),
    "hooke_scene_of_system": (STATUS, SYSTEM, TEXT, OPTIONS, TEXT, TEXT, POINTER(SCENE)),
    "hooke_scene_destroy": (None, SCENE),
    "hooke_scene_system": (SYSTEM, SCENE),
    "hooke_scene_run_options": (OPTIONS, SCENE),
    "hooke_scene_title": (TEXT, SCENE),
    "hooke_scene_text": (TEXT, SCENE),
    "hooke_mesh_read": (STATUS, TEXT, OPTIONS),
    "hooke_trajectory_create": (STATUS, TEXT, SYSTEM, INTEGRATOR, TEXT, POINTER(TRAJECTORY)),
    "hooke_trajectory_write": (STATUS, TRAJECTORY, INT64, STATE),
    "hooke_trajectory_write_behind": (STATUS, TRAJECTORY),
    "hooke_trajectory_sync": (STATUS, TRAJECTORY),
    "hooke_trajectory_run": (TEXT, TRAJECTORY),
    "hooke_trajectory_close": (STATUS, TRAJECTORY, INT32),
    "hooke_record_open": (STATUS, TEXT, POINTER(RECORD)),
    "hooke_record_close": (None, RECORD),
    "hooke_record_text": (TEXT, RECORD, TEXT),
    "hooke_record_options": (OPTIONS, RECORD),
    "hooke_record_frame_count": (INT64, RECORD),
    "hooke_record_check": (STATUS, RECORD, INT64),
    "hooke_record_read": (STATUS, RECORD, INT64, STATE),
    "hooke_record_size": (STATUS, RECORD, TEXT, INTEGERS, INTEGERS),
    "hooke_record_numbers": (STATUS, RECORD, TEXT, DOUBLES),
    "hooke_record_place": (INT64, RECORD, TEXT),
    "hooke_record_write_xdmf": (STATUS, RECORD, TEXT),
    "hooke_view_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_view_create": (STATUS, RECORD, OPTIONS, POINTER(VIEW)),
    "hooke_view_write": (STATUS, VIEW, TEXT, TEXT),
    "hooke_view_number": (DOUBLE, VIEW, TEXT),
    "hooke_view_destroy": (None, VIEW),
    "hooke_comparison_file_create": (STATUS, TEXT, SYSTEM, COMPARISON, TEXT, POINTER(COMPARISON_FILE)),
    "hooke_comparison_file_close": (STATUS, COMPARISON_FILE),
    "hooke_study_write_csv": (STATUS, STUDY, TEXT),
    "hooke_study_write_h5": (STATUS, STUDY, TEXT, TEXT, INT32),
    "hooke_study_write_report": (STATUS, STUDY, TEXT, TEXT, TEXT),
    "hooke_limit_write_report": (STATUS, LIMIT, STATE, TEXT, TEXT),
    "hooke_needs_write_report": (STATUS, NEEDS, TEXT, TEXT, TEXT),
    # checkpoint.h
    "hooke_checkpoint_write": (STATUS, TEXT, INTEGRATOR, STATE, TEXT),
    "hooke_checkpoint_read": (STATUS, TEXT, TEXT, INTEGRATOR, STATE),
    "hooke_trajectory_checkpoint": (STATUS, TRAJECTORY, INTEGRATOR, STATE),
    "hooke_trajectory_resume": (STATUS, TEXT, SYSTEM, INTEGRATOR, STATE, POINTER(TRAJECTORY)),
    "hooke_trajectory_origin": (TEXT, TRAJECTORY),
    # verify.h
    "hooke_verify_options_create": (STATUS, POINTER(OPTIONS)),
    "hooke_verify_create": (STATUS, TEXT, OPTIONS, OPTIONS, POINTER(VERIFY)),
    "hooke_verify_destroy": (None, VERIFY),
    "hooke_verify_on_progress": (None, VERIFY, PROGRESS, ADDRESS),
    "hooke_verify_run": (OUTCOME, VERIFY),
    "hooke_verify_text": (TEXT, VERIFY, TEXT),
    "hooke_verify_number": (DOUBLE, VERIFY, TEXT),
}
