package sprung.spy;

import java.io.IOException;
import javax.swing.JFrame;
import javax.swing.Timer;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;

/** Listens to JOINT_STATE and MOTION_STATE on $LCM_DEFAULT_URL, as lcm-spy does, and draws them 20 times a second. */
final class MotionWindow implements LCMSubscriber {
    private static final int REFRESH_MS = 50;
    private static final long EVERY_US = 5000; // what comes more often is not drawn
    private static MotionWindow only;

    private final MotionHistory history = new MotionHistory();
    private final JFrame frame = new JFrame("sprung: torques and phases");
    private long torquesAt;
    private long phasesAt;

    /** One window is enough: a second call brings it to the front. */
    static void open() {
        if (only == null) {
            only = new MotionWindow();
        }
        only.frame.setVisible(true);
        only.frame.toFront();
    }

    private MotionWindow() {
        final MotionPanel panel = new MotionPanel(history);
        frame.add(panel);
        frame.setSize(900, 560);
        frame.setLocation(40, 260);
        new Timer(REFRESH_MS, event -> panel.repaint()).start();
        LCM.getSingleton().subscribe("JOINT_STATE", this);
        LCM.getSingleton().subscribe("MOTION_STATE", this);
    }

    @Override
    public void messageReceived(LCM lcm, String channel, LCMDataInputStream stream) {
        try {
            final long now = System.nanoTime() / 1000;
            if (channel.equals("JOINT_STATE") && now >= torquesAt + EVERY_US) {
                torquesAt = now;
                history.add(new sprung_msgs.joint_state_t(stream));
            } else if (channel.equals("MOTION_STATE") && now >= phasesAt + EVERY_US) {
                phasesAt = now;
                history.add(new sprung_msgs.motion_state_t(stream));
            }
        } catch (IOException wrongBytes) {
            history.complain(channel + ": " + wrongBytes.getMessage());
        }
    }
}
