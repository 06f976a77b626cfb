//! The columns of the tables.

/// The columns that users rely on.
pub const COLUMNS: [(&str, &str); 11] = [
    (
        "summary",
        "case,nodes,elements,represented_atoms,steps,time_step_ps,wall_s,atom_steps_per_s,energy_error_relative,closest_approach_spacings,\
         cutoff_release_ev,initiation_strain,initiation_time_ps,k_ic_near_tip_mpa_sqrt_m,k_ic_j_integral_mpa_sqrt_m,\
         k_griffith_mpa_sqrt_m,peak_speed_over_c_r,first_branch_time_ps,first_branch_strain,\
         first_bond_strain,first_bond_time_ps,speed_share,joins,leaves_plane_time_ps,leaves_plane_strain,parted_elsewhere_strain",
    ),
    (
        "specimen",
        "case,length_asked_nm,length_nm,width_asked_nm,width_nm,height_between_grips_asked_nm,height_between_grips_nm,\
         crack_asked_nm,crack_nm,notch_end,grip_thickness_nm,grip_speed_m_per_s,leftover_share,leftover_where",
    ),
    (
        "crack_speed",
        "case,time_ps,strain,tip_x_nm,tip_y_nm,arc_length_nm,speed_m_per_s,speed_over_c_r,speed_error_m_per_s",
    ),
    (
        "stress_profile",
        "case,time_ps,distance_nm,sigma_xx_gpa,sigma_yy_gpa,sigma_xy_gpa,traction_x_gpa,traction_y_gpa",
    ),
    (
        "stress_strain",
        "case,time_ps,strain,sigma_xx_gpa,sigma_yy_gpa,kinetic_energy_ev,potential_energy_ev,work_ev,\
         cutoff_release_ev,temperature_k,refined_energy_ev,nodes,outruns",
    ),
    (
        "wave_arrival",
        "case,wave,path,predicted_ps,measured_ps,reference_ps,at_running_tip_ps",
    ),
    (
        "k_ic",
        "case,k_near_tip_mpa_sqrt_m,k_j_integral_mpa_sqrt_m,k_energy_balance_mpa_sqrt_m,k_between_grips_mpa_sqrt_m,\
         k_under_stress_mpa_sqrt_m,k_griffith_mpa_sqrt_m,k_ic_reference_mpa_sqrt_m,reasons",
    ),
    (
        "first_branch",
        "case,time_ps,strain,x_nm,y_nm,angle_deg,after_start_ps,reference_from_ps,reference_to_ps,\
         leaves_plane_time_ps,leaves_plane_after_start_ps,leaves_plane_strain,leaves_plane_x_nm,leaves_plane_y_nm,first_off_plane_after_start_ps",
    ),
    (
        "branches",
        "case,branch,parent,time_ps,strain,x_nm,y_nm,angle_deg,arrested",
    ),
    ("path", "case,time_ps,strain,x_nm,y_nm,direction_deg,closed_again"),
    ("cost", "case,ranks,threads,phase,calls,seconds,seconds_per_step"),
];
