package sprung.spy;

import java.awt.event.ActionEvent;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.SwingUtilities;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/** Makes a double click on JOINT_STATE or MOTION_STATE in lcm-spy open torques and phases; lcm-spy finds it by itself in the jar. */
public class SprungPlugin implements SpyPlugin {
    /** With -Dsprung.open=true the window is there from the start. */
    public SprungPlugin() {
        if (Boolean.getBoolean("sprung.open")) {
            SwingUtilities.invokeLater(MotionWindow::open);
        }
    }

    @Override
    public boolean canHandle(long fingerprint) {
        return fingerprint == sprung_msgs.joint_state_t.LCM_FINGERPRINT
            || fingerprint == sprung_msgs.motion_state_t.LCM_FINGERPRINT;
    }

    @Override
    public Action getAction(JDesktopPane desktop, ChannelData channel) {
        return new AbstractAction("Torques and phases") {
            @Override
            public void actionPerformed(ActionEvent event) {
                MotionWindow.open();
            }
        };
    }
}
