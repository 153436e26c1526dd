package sprung.spy;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.List;

/** The last seconds of torques and phases. One thread adds, another draws. */
final class MotionHistory {
    static final double SECONDS = 10.0;

    /** Torques of all joints, Nm at the gears' output, at one time. */
    static final class Torques {
        final double time_s;
        final double[] torque_Nm;

        Torques(double time_s, double[] torque_Nm) {
            this.time_s = time_s;
            this.torque_Nm = torque_Nm;
        }
    }

    /** Phases of all legs from one time on. */
    static final class Phases {
        final double time_s;
        final int[] phases;
        final String state;

        Phases(double time_s, int[] phases, String state) {
            this.time_s = time_s;
            this.phases = phases;
            this.state = state;
        }
    }

    private final Deque<Torques> torques = new ArrayDeque<>();
    private final Deque<Phases> phases = new ArrayDeque<>();
    private String complaint = "";

    synchronized void add(sprung_msgs.joint_state_t message) {
        final double[] all = new double[message.n_joints];
        for (int i = 0; i < all.length; ++i) {
            all[i] = message.joints[i].gear_output_torque_Nm;
        }
        final double time_s = message.utime * 1e-6;
        if (!torques.isEmpty() && time_s < torques.getLast().time_s) {
            clear(); // another session
        }
        torques.add(new Torques(time_s, all));
        while (torques.getFirst().time_s < time_s - SECONDS) {
            torques.removeFirst();
        }
    }

    synchronized void add(sprung_msgs.motion_state_t message) {
        final int[] all = new int[message.n_legs];
        for (int i = 0; i < all.length; ++i) {
            all[i] = message.legs[i].phase;
        }
        final double time_s = message.utime * 1e-6;
        if (!phases.isEmpty() && time_s < phases.getLast().time_s) {
            clear();
        }
        phases.add(new Phases(time_s, all, message.state_name));
        while (phases.getFirst().time_s < time_s - SECONDS) {
            phases.removeFirst();
        }
    }

    synchronized void complain(String text) {
        complaint = text;
    }

    synchronized String complaint() {
        return complaint;
    }

    synchronized List<Torques> torques() {
        return new ArrayList<>(torques);
    }

    synchronized List<Phases> phases() {
        return new ArrayList<>(phases);
    }

    private void clear() {
        torques.clear();
        phases.clear();
    }
}
